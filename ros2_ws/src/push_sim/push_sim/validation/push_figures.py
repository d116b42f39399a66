"""Figures of pushes: predicted against measured motion, and end poses."""

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_core.data import READABLE, in_push_frame
from push_core.geometry import Array, points_to_body, wrap_angles
from push_report.page import COLOURS

from push_sim.validation.comparison import LongComparison, ShortComparison

_TITLES = ('along the push [mm]', 'across [mm]', 'rotation [deg]')
_SERIES = (('simulator', COLOURS[0]), ('ellipsoid', COLOURS[1]))
_PANELS = {'horizontal_spacing': 0.08}
_HEIGHT = 600
LEGEND = {'orientation': 'h', 'y': -0.22, 'yanchor': 'top', 'itemsizing': 'constant'}


def short_figure(compared: ShortComparison) -> go.Figure:
    """Short pushes in the push frame, predicted against measured, one panel for each output."""
    beta = compared.pushes.beta
    measured = in_push_frame(compared.pushes.displacement, beta) / READABLE
    predicted = [in_push_frame(each, beta) / READABLE for each in _both(compared)]
    figure = make_subplots(1, 3, subplot_titles=_TITLES, **_PANELS)
    for column in range(3):
        for each, (name, colour) in zip(predicted, _SERIES, strict=True):
            _dots(figure, column, measured[:, column], each[:, column], name, colour)
        _diagonal(figure, column, measured[:, column])
    figure.update_xaxes(title_text='measured').update_yaxes(title_text='predicted', col=1)
    length = f'{compared.pushes.distance * 1e3:g} mm'
    title = f'{len(measured)} pushes of {length}, predicted against measured'
    return figure.update_layout(title_text=title, legend=LEGEND)


def long_figure(compared: LongComparison) -> go.Figure:
    """Long pushes on the face: lines from measured to simulated ends, and the rotations."""
    pushes = compared.pushes
    chosen = np.flatnonzero(pushes.on_face)
    measured, *predicted = (
        _in_start_frame(pushes.start[chosen], end[chosen])
        for end in (pushes.end, *_both(compared))
    )
    titles = ('ends in the start frame, x away from the face [mm]', 'rotation [deg]')
    figure = make_subplots(1, 2, subplot_titles=titles, column_widths=[0.6, 0.4], **_PANELS)
    _arrows(figure, measured, predicted[0])
    for each, (name, colour) in zip(predicted, _SERIES, strict=True):
        _dots(figure, 1, measured[:, 2], each[:, 2], name, colour)
    _diagonal(figure, 1, measured[:, 2])
    figure.update_xaxes(title_text='y [mm]', row=1, col=1)
    figure.update_yaxes(title_text='x [mm]', scaleanchor='x', row=1, col=1)
    figure.update_xaxes(title_text='measured', row=1, col=2)
    figure.update_yaxes(title_text='predicted', row=1, col=2)
    title = f'{compared.file}: {len(chosen)} pushes that stay on the face'
    return figure.update_layout(title_text=title, height=_HEIGHT, legend=LEGEND)


def _both(compared: ShortComparison | LongComparison) -> tuple[Array, Array]:
    return compared.simulated, compared.ellipsoid


def _in_start_frame(start: Array, end: Array) -> Array:
    """(n, 3) x, y [mm] and rotation [deg] of end poses (n, 3) in the start frames (n, 3)."""
    moved = points_to_body(start, end[:, :2])
    turned = wrap_angles(end[:, 2] - start[:, 2])
    return np.asarray(np.column_stack((moved, turned)) / READABLE)


def _dots(
    figure: go.Figure, column: int, measured: Array, predicted: Array, name: str, colour: str
) -> None:
    figure.add_trace(
        go.Scattergl(
            x=np.float32(measured),
            y=np.float32(predicted),
            mode='markers',
            name=name,
            legendgroup=name,
            showlegend=column < 2 and not _named(figure, name),
            marker={'size': 4, 'color': colour, 'opacity': 0.55},
        ),
        row=1,
        col=column + 1,
    )


def _named(figure: go.Figure, name: str) -> bool:
    return any(trace.name == name for trace in figure.data)


def _diagonal(figure: go.Figure, column: int, measured: Array) -> None:
    ends = [float(measured.min()), float(measured.max())]
    line = {'color': 'black', 'width': 1}
    trace = go.Scatter(x=ends, y=ends, mode='lines', line=line, showlegend=False)
    figure.add_trace(trace, row=1, col=column + 1)


def _arrows(figure: go.Figure, measured: Array, simulated: Array) -> None:
    """Lines from measured to simulated ends, with a dot at the measured one."""
    gaps = np.full(len(measured), np.nan)
    x = np.column_stack((measured[:, 0], simulated[:, 0], gaps)).ravel()
    y = np.column_stack((measured[:, 1], simulated[:, 1], gaps)).ravel()
    line = {'color': _SERIES[0][1], 'width': 1}
    figure.add_trace(
        go.Scatter(x=y, y=x, mode='lines', line=line, name='to the simulated end'), row=1, col=1
    )
    marker = {'size': 4, 'color': 'black'}
    figure.add_trace(
        go.Scatter(
            x=measured[:, 1], y=measured[:, 0], mode='markers', marker=marker, name='measured end'
        ),
        row=1,
        col=1,
    )
