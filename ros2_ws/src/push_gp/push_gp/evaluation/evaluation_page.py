"""HTML page of a model on measured pushes: scatter plots and calibration."""

import math
from collections.abc import Sequence
from pathlib import Path
from statistics import NormalDist

import numpy as np
import plotly.graph_objects as go
from push_core.data import OUTPUTS, READABLE, PushSet
from push_core.geometry import Array
from push_report.figure_style import BLUE, DIVERGING, GREEN, INK, MOST_MARKERS, RED, thinned
from push_report.page import write_page

from push_gp.evaluation.summary import UNITS
from push_gp.models import GpModel, PushModel

LEVELS = np.linspace(0.05, 0.99, 48)
COLOURS = (BLUE, RED, GREEN)
TEXT = (
    'The model predicts pushes that it was not trained on. Displacements are in the body frame '
    f'at the start of a push. At most {MOST_MARKERS} pushes are drawn, evenly chosen; the '
    'numbers are of all. Colours end at the 98 % quantile of the error; larger ones have the '
    'last colour.'
)
TITLES = [f'{name} [{unit}]' for name, unit in zip(OUTPUTS, UNITS, strict=True)]


def write_evaluation_page(
    path: Path, model: PushModel, pushes: PushSet, lines: Sequence[str]
) -> None:
    """Writes the page.

    Args:
        path: of the HTML file.
        model: to evaluate.
        pushes: measured.
        lines: the errors as text, above the figures.

    Raises:
        InputError: the file cannot be written.
    """
    predicted, _ = model.evaluate(pushes.p_y, pushes.beta)
    parts: list[tuple[str, Sequence[go.Figure]]] = [
        ('Predicted against measured', _against(predicted, pushes)),
        ('Measured minus predicted, by contact offset and direction', _errors(predicted, pushes)),
    ]
    if isinstance(model, GpModel):
        half = 1.96 * math.sqrt(0.95 * 0.05 / len(pushes))
        heading = f'Calibration (sampling error at 95 %: ±{100 * half:.1f} %)'
        parts.append((heading, [_calibration(model, predicted, pushes)]))
    write_page(path, f'Model {model.info.model_id} on {len(pushes)} pushes', lines, parts, TEXT)


def _against(predicted: Array, pushes: PushSet) -> list[go.Figure]:
    """A figure of each output: a dot for each push, on the line where the model is right."""
    figures = []
    for column, title in enumerate(TITLES):
        measured, expected = thinned(
            pushes.displacement[:, column] / READABLE[column],
            predicted[:, column] / READABLE[column],
            most=MOST_MARKERS,
        )
        ends = [float(measured.min()), float(measured.max())]
        dots = {'size': 3, 'color': COLOURS[column]}
        figure = go.Figure()
        figure.add_scatter(x=measured, y=expected, mode='markers', marker=dots)
        figure.add_scatter(x=ends, y=ends, mode='lines', line={'color': INK, 'width': 1})
        figure.update_layout(showlegend=False)
        figure.update_xaxes(title=f'measured {title}')
        figures.append(figure.update_yaxes(title=f'predicted {title}'))
    return figures


def _errors(predicted: Array, pushes: PushSet) -> list[go.Figure]:
    """A figure of each output: the error as colour over the inputs."""
    figures = []
    for column, title in enumerate(TITLES):
        error = (pushes.displacement - predicted)[:, column] / READABLE[column]
        reach = float(np.quantile(np.abs(error), 0.98))
        x, y, error = thinned(1e3 * pushes.p_y, np.degrees(pushes.beta), error, most=MOST_MARKERS)
        bar = {'thickness': 10, 'title': {'text': f'error {title}', 'side': 'right'}}
        dots = {'size': 4, 'color': error, 'colorscale': DIVERGING, 'colorbar': bar}
        dots |= {'cmin': -reach, 'cmax': reach}
        figure = go.Figure().add_scatter(x=x, y=y, mode='markers', marker=dots)
        figure.update_xaxes(title='p_y [mm]')
        figures.append(figure.update_yaxes(title='beta [deg]'))
    return figures


def _calibration(model: GpModel, predicted: Array, pushes: PushSet) -> go.Figure:
    """Coverage of normal intervals of each level; a dot is that of the model's 95 % interval."""
    spread = np.sqrt(model.variance(pushes.p_y, pushes.beta) + model.noise_variance)
    deviations = np.abs(pushes.displacement - predicted) / spread
    reach = np.array([NormalDist().inv_cdf(0.5 + level / 2.0) for level in LEVELS])
    figure = go.Figure()
    figure.add_scatter(x=[0, 1], y=[0, 1], mode='lines', line={'color': INK}, name='ideal')
    for column, name in enumerate(OUTPUTS):
        shares = np.mean(deviations[:, column] <= reach[:, None], axis=1)
        line = {'color': COLOURS[column]}
        figure.add_scatter(x=LEVELS, y=shares, mode='lines', line=line, name=name)
        own = float(np.mean(deviations[:, column] <= model.interval_95[column]))
        figure.add_scatter(x=[0.95], y=[own], mode='markers', marker=line, showlegend=False)
    figure.update_xaxes(title='level of the interval, normal errors')
    return figure.update_yaxes(title='share of pushes in the interval')
