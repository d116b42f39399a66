"""Figures of a robot run: commanded, modelled and sensed tip, and the simulated windows."""

import numpy as np
import plotly.graph_objects as go
from push_core.geometry import Array
from push_report.figure_style import BLUE, GREY, INK, RED

from push_sim.validation.comparison import RunComparison
from push_sim.validation.push_figures import Part

_MOST_POINTS = 2000
_LEAST_RANGE = 1.0


def run_figures(compared: RunComparison) -> Part:
    """Paths of the tip, error of the actuator model over time, and the object in its windows."""
    run, following = compared.run, compared.run.following
    time, commanded, sensed, tip = (
        _subsampled(each[:following]) for each in (run.time, run.commanded, run.tip, compared.tip)
    )
    return run.name, [
        _tip_figure(commanded, sensed, tip),
        _error_figure(time, (tip - sensed) * 1e3),
        _object_figure(compared),
    ]


def _tip_figure(commanded: Array, sensed: Array, tip: Array) -> go.Figure:
    figure = go.Figure()
    for points, name, colour in (
        (commanded, 'commanded tip', GREY),
        (sensed, 'sensed tip', INK),
        (tip, 'model of the actuator', BLUE),
    ):
        x, y = (points * 1e3).astype(np.float32).T
        line = {'color': colour, 'width': 1.5}
        figure.add_scatter(x=x, y=y, mode='lines', name=name, line=line)
    figure.update_xaxes(title='x [mm]')
    return figure.update_yaxes(title='y [mm]', range=_range(tip[:, 1] * 1e3))


def _error_figure(time: Array, error: Array) -> go.Figure:
    figure = go.Figure()
    for axis, (name, colour) in enumerate((('x', BLUE), ('y', RED))):
        line = {'color': colour, 'width': 1}
        figure.add_scatter(x=time, y=error[:, axis], name=f'{name} error', line=line)
    figure.update_xaxes(title='time [s]')
    return figure.update_yaxes(title='modelled minus sensed tip [mm]')


def _range(values: Array) -> list[float]:
    """Axis range of at least about a millimetre, so that a straight line looks straight."""
    middle = 0.5 * float(values.min() + values.max())
    half = 0.6 * max(float(np.ptp(values)), _LEAST_RANGE)
    return [middle - half, middle + half]


def _subsampled(values: Array) -> Array:
    step = max(1, -(-len(values) // _MOST_POINTS))
    return values[::step]


def _object_figure(compared: RunComparison) -> go.Figure:
    """The measured path, and from the start of each window a line to its simulated end."""
    x, y = (_subsampled(compared.run.pose)[:, :2] * 1e3).astype(np.float32).T
    figure = go.Figure()
    figure.add_scatter(x=x, y=y, mode='lines', name='measured object', line={'color': INK})
    starts, ends = compared.windows.start[:, :2] * 1e3, compared.simulated[:, :2] * 1e3
    lines = np.stack((starts, ends, np.full_like(ends, np.nan)), axis=1).reshape(-1, 2)
    figure.add_scatter(
        x=lines[:, 0],
        y=lines[:, 1],
        mode='lines+markers',
        name='simulated, 0.5 s from each measured pose',
        line={'color': RED, 'width': 1.5},
        marker={'size': 4},
    )
    figure.update_xaxes(title='x [mm]')
    return figure.update_yaxes(title='y [mm]')
