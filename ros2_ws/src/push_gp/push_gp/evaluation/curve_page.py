"""The learning curve as an HTML page."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import plotly.graph_objects as go
from push_report.figure_style import BLUE, GREEN, RED
from push_report.page import write_page

from push_gp.evaluation.curve import LIMIT_SURFACE, METHODS, CurvePoint

COLOURS = (BLUE, RED, GREEN)
TEXT = (
    'Models are trained on more and more of the pushes and judged on those held out, by the '
    'mean squared error as a share of the variance (NMSE) in the push frame.'
)
NAMES = {
    'zero': 'GP, zero mean',
    'analytical': 'GP over the fitted motion cone',
    LIMIT_SURFACE: 'fitted motion cone alone',
}


def write_curve_page(path: Path, points: Sequence[CurvePoint], lines: Sequence[str]) -> None:
    """Writes the page.

    Args:
        path: of the HTML file.
        points: of the curve, all sizes and methods.
        lines: the same as text, above the figure.

    Raises:
        InputError: the file cannot be written.
    """
    parts = [('Median and quartiles over the seeds', [curve_figure(points)])]
    write_page(path, 'Learning curve', lines, parts, TEXT)


def curve_figure(points: Sequence[CurvePoint]) -> go.Figure:
    """Median and quartiles over the seeds of each method."""
    figure = go.Figure()
    for colour, method in zip(COLOURS, METHODS, strict=True):
        mine = [point for point in points if point.method == method]
        sizes = [point.points for point in mine]
        low, median, high = np.quantile([point.nmse for point in mine], [0.25, 0.5, 0.75], axis=1)
        spread = {'array': high - median, 'arrayminus': median - low}
        figure.add_scatter(
            x=sizes, y=median, error_y=spread, name=NAMES[method], line={'color': colour}
        )
    figure.update_xaxes(title_text='training pushes', type='log')
    return figure.update_yaxes(title_text='mean NMSE, push frame', type='log')
