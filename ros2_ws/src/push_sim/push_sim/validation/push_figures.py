"""Figures of pushes: predicted against measured motion, and end poses."""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from push_core.data import READABLE, in_push_frame
from push_core.geometry import Array, points_to_body, wrap_angles
from push_report.figure_style import BLUE, INK, MOST_MARKERS, RED, thinned

from push_sim.validation.comparison import LongComparison, ShortComparison

_TITLES = ('along the push [mm]', 'across [mm]', 'rotation [deg]')
_SERIES = (('simulator', BLUE), ('ellipsoid', RED))
_HEIGHT = 600

Part = tuple[str, list[go.Figure]]
"""Heading and figures of a section."""


def short_figures(compared: ShortComparison) -> Part:
    """Short pushes in the push frame, predicted against measured, a figure for each output."""
    beta = compared.pushes.beta
    measured = in_push_frame(compared.pushes.displacement, beta) / READABLE
    predicted = [in_push_frame(each, beta) / READABLE for each in _both(compared)]
    figures = [
        _against(title, measured[:, column], [each[:, column] for each in predicted])
        for column, title in enumerate(_TITLES)
    ]
    length = f'{compared.pushes.distance * 1e3:g} mm'
    return f'{len(measured)} pushes of {length}, predicted against measured', figures


def long_figures(compared: LongComparison) -> Part:
    """Long pushes on the face: lines from measured to simulated ends, and the rotations."""
    pushes = compared.pushes
    chosen = np.flatnonzero(pushes.on_face)
    measured, *predicted = (
        _in_start_frame(pushes.start[chosen], end[chosen])
        for end in (pushes.end, *_both(compared))
    )
    ends = _arrows(measured, predicted[0])
    ends.update_xaxes(title='y [mm]')
    ends.update_yaxes(title='x in the start frame, away from the face [mm]', scaleanchor='x')
    ends.update_layout(height=_HEIGHT)
    turns = _against(_TITLES[2], measured[:, 2], [each[:, 2] for each in predicted])
    turns.update_layout(height=_HEIGHT)
    return f'{compared.file}: {len(chosen)} pushes that stay on the face', [ends, turns]


def _both(compared: ShortComparison | LongComparison) -> tuple[Array, Array]:
    return compared.simulated, compared.ellipsoid


def _in_start_frame(start: Array, end: Array) -> Array:
    """(n, 3) x, y [mm] and rotation [deg] of end poses (n, 3) in the start frames (n, 3)."""
    moved = points_to_body(start, end[:, :2])
    turned = wrap_angles(end[:, 2] - start[:, 2])
    return np.asarray(np.column_stack((moved, turned)) / READABLE)


def _against(title: str, measured: Array, predicted: Sequence[Array]) -> go.Figure:
    """Predicted over measured values (n,), on the line where they are equal."""
    figure = go.Figure()
    for each, (name, colour) in zip(predicted, _SERIES, strict=True):
        x, y = thinned(measured, each, most=MOST_MARKERS)
        dots = {'size': 4, 'color': colour, 'opacity': 0.55}
        figure.add_scatter(x=x, y=y, mode='markers', name=name, marker=dots)
    ends = [float(measured.min()), float(measured.max())]
    line = {'color': INK, 'width': 1}
    figure.add_scatter(x=ends, y=ends, mode='lines', line=line, showlegend=False)
    figure.update_xaxes(title=f'measured {title}')
    return figure.update_yaxes(title=f'predicted {title}')


def _arrows(measured: Array, simulated: Array) -> go.Figure:
    """Lines from measured to simulated ends, with a dot at the measured one."""
    gaps = np.full(len(measured), np.nan)
    x = np.column_stack((measured[:, 0], simulated[:, 0], gaps)).ravel()
    y = np.column_stack((measured[:, 1], simulated[:, 1], gaps)).ravel()
    line = {'color': BLUE, 'width': 1}
    marker = {'size': 4, 'color': INK}
    figure = go.Figure()
    figure.add_scatter(x=y, y=x, mode='lines', line=line, name='to the simulated end')
    return figure.add_scatter(
        x=measured[:, 1], y=measured[:, 0], mode='markers', marker=marker, name='measured end'
    )
