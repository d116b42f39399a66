"""HTML page of the end errors of a model that is rolled out along long pushes."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from plotly.subplots import make_subplots
from push_report.page import COLOURS, write_page

from push_gp.evaluation.evaluation import RolloutEvaluation

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
    figure = make_subplots(1, 2, subplot_titles=[title for _, title, _ in SHOWN])
    groups = (('on the face', result.pushes.on_face), ('off it', ~result.pushes.on_face))
    for column, (kind, _, scale) in enumerate(SHOWN, start=1):
        errors = scale * getattr(result.errors, kind)
        for colour, (name, chosen) in zip(COLOURS, groups, strict=False):
            figure.add_histogram(
                x=errors[chosen],
                name=name,
                marker={'color': colour},
                showlegend=column == 1,
                row=1,
                col=column,
            )
    figure.update_layout(title_text='Errors at the end of each push', barmode='stack')
    title = f'Model {result.model_id} rolled out along {len(result.pushes)} pushes'
    write_page(path, title, lines, [figure])
