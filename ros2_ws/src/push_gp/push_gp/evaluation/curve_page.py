"""The learning curve as a picture."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import plotly.graph_objects as go
from push_report.page import COLOURS, write_page

from push_gp.evaluation.learning_curve import LIMIT_SURFACE, METHODS, Place

NAMES = {
    'zero': 'GP, zero mean',
    'analytical': 'GP over the fitted motion cone',
    LIMIT_SURFACE: 'fitted motion cone alone',
}


def write_curve_page(path: Path, places: Sequence[Place], lines: Sequence[str]) -> None:
    """Writes the page.

    Args:
        path: of the HTML file.
        places: of the curve.
        lines: the figures in words.

    Raises:
        InputError: the file cannot be written.
    """
    write_page(path, 'Learning curve', lines, [curve_figure(places)])


def curve_figure(places: Sequence[Place]) -> go.Figure:
    """Median and quartiles over the seeds of each method."""
    figure = go.Figure()
    for colour, method in zip(COLOURS, METHODS, strict=True):
        mine = [place for place in places if place.method == method]
        points = [place.points for place in mine]
        low, median, high = np.quantile([place.nmse for place in mine], [0.25, 0.5, 0.75], axis=1)
        spread = {'array': high - median, 'arrayminus': median - low}
        figure.add_scatter(
            x=points, y=median, error_y=spread, name=NAMES[method], line={'color': colour}
        )
    figure.update_xaxes(title_text='training pushes', type='log')
    figure.update_yaxes(title_text='mean NMSE, push frame', type='log')
    return figure.update_layout(title_text='Median and quartiles over the seeds')
