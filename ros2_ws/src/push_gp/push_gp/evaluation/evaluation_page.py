"""HTML page of a model on measured pushes: scatter plots and calibration."""

import math
from collections.abc import Sequence
from pathlib import Path
from statistics import NormalDist

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_core.data import OUTPUTS, READABLE, PushSet
from push_core.geometry import Array
from push_report.page import COLOURS, DIVERGING, write_page

from push_gp.evaluation.summary import UNITS
from push_gp.models import GpModel, PushModel

LEVELS = np.linspace(0.05, 0.99, 48)
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
    figures = [_against(predicted, pushes), _over_inputs(predicted, pushes)]
    if isinstance(model, GpModel):
        figures.append(_calibration(model, predicted, pushes))
    write_page(path, f'Model {model.info.model_id} on {len(pushes)} pushes', lines, figures)


def _against(predicted: Array, pushes: PushSet) -> go.Figure:
    figure = make_subplots(1, 3, subplot_titles=TITLES)
    for column in range(3):
        measured = pushes.displacement[:, column] / READABLE[column]
        expected = predicted[:, column] / READABLE[column]
        ends = [measured.min(), measured.max()]
        dots = {'size': 3, 'color': COLOURS[column]}
        line = {'color': 'black', 'width': 1}
        figure.add_scatter(
            x=measured, y=expected, mode='markers', marker=dots, row=1, col=column + 1
        )
        figure.add_scatter(x=ends, y=ends, mode='lines', line=line, row=1, col=column + 1)
    figure.update_xaxes(title_text='measured').update_yaxes(title_text='predicted', col=1)
    return figure.update_layout(title_text='Predicted against measured', showlegend=False)


def _over_inputs(predicted: Array, pushes: PushSet) -> go.Figure:
    figure = make_subplots(1, 3, subplot_titles=TITLES, horizontal_spacing=0.1)
    for column in range(3):
        error = (pushes.displacement - predicted)[:, column] / READABLE[column]
        reach = float(np.quantile(np.abs(error), 0.98))
        bar = {'x': 0.27 + 0.367 * column, 'len': 0.9, 'thickness': 10}
        dots = {'size': 4, 'color': error, 'colorscale': DIVERGING, 'cmid': 0.0}
        dots |= {'cmin': -reach, 'cmax': reach, 'colorbar': bar}
        x, y = 1e3 * pushes.p_y, np.degrees(pushes.beta)
        figure.add_scatter(x=x, y=y, mode='markers', marker=dots, row=1, col=column + 1)
    figure.update_xaxes(title_text='p_y [mm]').update_yaxes(title_text='beta [deg]', col=1)
    return figure.update_layout(title_text='Measured minus predicted', showlegend=False)


def _calibration(model: GpModel, predicted: Array, pushes: PushSet) -> go.Figure:
    """Coverage of normal intervals of each level; a dot is that of the model's 95 % interval."""
    spread = np.sqrt(model.variance(pushes.p_y, pushes.beta) + model.noise_variance)
    deviations = np.abs(pushes.displacement - predicted) / spread
    reach = np.array([NormalDist().inv_cdf(0.5 + level / 2.0) for level in LEVELS])
    figure = go.Figure()
    figure.add_scatter(x=[0, 1], y=[0, 1], mode='lines', line={'color': 'black'}, name='ideal')
    for column, name in enumerate(OUTPUTS):
        shares = np.mean(deviations[:, column] <= reach[:, None], axis=1)
        line = {'color': COLOURS[column]}
        figure.add_scatter(x=LEVELS, y=shares, mode='lines', line=line, name=name)
        own = float(np.mean(deviations[:, column] <= model.interval_95[column]))
        figure.add_scatter(x=[0.95], y=[own], mode='markers', marker=line, showlegend=False)
    figure.update_xaxes(title_text='level of the interval, normal errors')
    figure.update_yaxes(title_text='share of pushes in the interval')
    half = 1.96 * math.sqrt(0.95 * 0.05 / len(pushes))
    title = f'Calibration (sampling error at 95 %: ±{100 * half:.1f} %)'
    return figure.update_layout(title_text=title)
