"""HTML page of the end errors of a model that is rolled out along long pushes."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import plotly.graph_objects as go
from push_report.figure_style import BLUE, RED
from push_report.page import write_page

from push_gp.evaluation.evaluation import RolloutEvaluation

BINS = 40
TEXT = (
    'The model is applied step by step along each long push, from its measured start; the '
    'errors are those of the pose at its end. Pushes whose tip leaves the face are a group of '
    'their own.'
)
SHOWN = (('position', 'position [mm]', 1e3), ('heading', 'heading [deg]', 180.0 / np.pi))


def write_rollout_page(path: Path, result: RolloutEvaluation, lines: Sequence[str]) -> None:
    """Writes the page.

    Args:
        path: of the HTML file.
        result: errors at the ends.
        lines: the errors as text, above the figure.

    Raises:
        InputError: the file cannot be written.
    """
    groups = (('on the face', result.pushes.on_face), ('off it', ~result.pushes.on_face))
    figures = []
    for kind, title, scale in SHOWN:
        errors = scale * getattr(result.errors, kind)
        edges = np.histogram_bin_edges(errors, BINS)
        figure = go.Figure()
        for colour, (name, chosen) in zip((BLUE, RED), groups, strict=True):
            count, _ = np.histogram(errors[chosen], edges)
            figure.add_bar(
                x=(edges[:-1] + edges[1:]) / 2.0, y=count, name=name, marker={'color': colour}
            )
        figure.update_layout(barmode='stack', bargap=0.05)
        figure.update_xaxes(title=title)
        figures.append(figure.update_yaxes(title='pushes'))
    title = f'Model {result.model_id} rolled out along {len(result.pushes)} pushes'
    write_page(path, title, lines, [('Errors at the end of each push', figures)], TEXT)
