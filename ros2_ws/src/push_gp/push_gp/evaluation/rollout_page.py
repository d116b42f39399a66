"""Pictures of how a model, step by step, tells where long pushes end."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from plotly.subplots import make_subplots
from push_report.page import COLOURS, write_page

from push_gp.evaluation.evaluation import RolloutEvaluation

SHOWN = (('position', 'position [mm]', 1e3), ('heading', 'heading [deg]', 180.0 / np.pi))


def write_rollout_page(path: Path, found: RolloutEvaluation, lines: Sequence[str]) -> None:
    """Writes the page.

    Args:
        path: of the HTML file.
        found: what is shown.
        lines: the figures in words.

    Raises:
        InputError: the file cannot be written.
    """
    figure = make_subplots(1, 2, subplot_titles=[title for _, title, _ in SHOWN])
    groups = (('on the face', found.pushes.on_face), ('off it', ~found.pushes.on_face))
    for column, (kind, _, scale) in enumerate(SHOWN, start=1):
        errors = scale * getattr(found.errors, kind)
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
    title = f'Model {found.model_id} rolled out along {len(found.pushes)} pushes'
    write_page(path, title, lines, [figure])
