"""Figure of a robot run: commanded, modelled and sensed tip, and the simulated windows."""

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_core.geometry import Array
from push_report.page import COLOURS

from push_sim.validation.comparison import RunComparison
from push_sim.validation.push_figures import LEGEND

_TITLES = ('tip on the table', 'modelled minus sensed tip', 'object')
_MOST_POINTS = 2000
_LEAST_RANGE = 1.0
_HEIGHT = 680
_GREY = '#9aa5b1'


def run_figure(compared: RunComparison) -> go.Figure:
    """Paths of the tip, error of the actuator model over time, and the object in its windows."""
    run, following = compared.run, compared.run.following
    figure = make_subplots(2, 2, specs=[[{}, {}], [{'colspan': 2}, None]], subplot_titles=_TITLES)
    time, commanded, sensed, tip = (
        _subsampled(each[:following]) for each in (run.time, run.commanded, run.tip, compared.tip)
    )
    for points, name, colour in (
        (commanded, 'commanded', _GREY),
        (sensed, 'sensed', 'black'),
        (tip, 'model of the actuator', COLOURS[0]),
    ):
        _path(figure, points, name, colour)
    for axis, name in enumerate('xy'):
        line = {'color': COLOURS[axis], 'width': 1}
        gap = (tip - sensed)[:, axis] * 1e3
        figure.add_trace(go.Scatter(x=time, y=gap, name=f'{name} error', line=line), row=1, col=2)
    _object(figure, compared)
    figure.update_xaxes(title_text='x [mm]', row=1, col=1)
    figure.update_yaxes(title_text='y [mm]', range=_range(tip[:, 1] * 1e3), row=1, col=1)
    figure.update_xaxes(title_text='time [s]', row=1, col=2)
    figure.update_yaxes(title_text='[mm]', row=1, col=2)
    figure.update_xaxes(title_text='x [mm]', row=2, col=1)
    figure.update_yaxes(title_text='y [mm]', row=2, col=1)
    return figure.update_layout(title_text=run.name, height=_HEIGHT, legend=LEGEND)


def _range(values: Array) -> list[float]:
    """Axis range of at least about a millimetre, so that a straight line looks straight."""
    middle = 0.5 * float(values.min() + values.max())
    half = 0.6 * max(float(np.ptp(values)), _LEAST_RANGE)
    return [middle - half, middle + half]


def _subsampled(values: Array) -> Array:
    step = max(1, -(-len(values) // _MOST_POINTS))
    return values[::step]


def _path(figure: go.Figure, points: Array, name: str, colour: str) -> None:
    x, y = (points * 1e3).astype(np.float32).T
    line = {'color': colour, 'width': 1.5}
    figure.add_trace(go.Scatter(x=x, y=y, mode='lines', name=name, line=line), row=1, col=1)


def _object(figure: go.Figure, compared: RunComparison) -> None:
    """The measured path, and from the start of each window a line to its simulated end."""
    x, y = (_subsampled(compared.run.pose)[:, :2] * 1e3).astype(np.float32).T
    measured = go.Scatter(x=x, y=y, mode='lines', name='measured object', line={'color': 'black'})
    figure.add_trace(measured, row=2, col=1)
    starts, ends = compared.windows.start[:, :2] * 1e3, compared.simulated[:, :2] * 1e3
    lines = np.stack((starts, ends, np.full_like(ends, np.nan)), axis=1).reshape(-1, 2)
    simulated = go.Scatter(
        x=lines[:, 0],
        y=lines[:, 1],
        mode='lines+markers',
        name='simulated, 0.5 s from each measured pose',
        line={'color': COLOURS[1], 'width': 1.5},
        marker={'size': 4},
    )
    figure.add_trace(simulated, row=2, col=1)
