"""The square, the tip and the planned horizon as they moved, for the report's animation.

The figure holds the still part and empty traces; `report.js` moves them along the data written
here, which is thinned to FRAMES_PER_SECOND and in tenths of a millimetre.
"""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from push_report.figure_style import GREY, INK, ORANGE, styled, thinned

from push_bag.report.view import View
from push_bag.run import Floats, Horizons

FRAMES_PER_SECOND = 25.0
MOST_FRAMES = 4000
HEIGHT = 620
MARGIN = 80.0  # [mm] round the reference, so that the whole square is seen
PARTS = ('trail', 'object', 'horizon', 'pusher')


def animation_figure(views: Sequence[View]) -> go.Figure:
    """References, and for each run the traces of PARTS, which `report.js` fills."""
    figure = go.Figure()
    for view in views:
        figure.add_trace(_reference(view))
    for view in views:
        for trace in _moving(view, alone=len(views) == 1):
            figure.add_trace(trace)
    styled(figure, HEIGHT, hovermode=False)
    x, y = _span(views)
    figure.update_xaxes(title='x [mm]', range=x)
    return figure.update_yaxes(title='y [mm]', range=y, scaleanchor='x', scaleratio=1.0)


def animation_data(views: Sequence[View]) -> str:
    """What `report.js` moves the traces along, as JSON."""
    data = {
        'first_trace': len(views),
        'duration': max(view.reference.duration for view in views),
        'runs': [_frames(view) for view in views],
    }
    return json.dumps(data, separators=(',', ':'))


def _reference(view: View) -> go.Scatter:
    x, y = thinned(view.reference.pose[:, 0] * 1e3, view.reference.pose[:, 1] * 1e3)
    line = {'color': INK, 'width': 1.2, 'dash': 'dot'}
    return go.Scatter(x=x, y=y, mode='lines', name='reference', line=line, showlegend=False)


def _moving(view: View, alone: bool) -> list[go.Scatter]:
    styles: dict[str, dict[str, Any]] = {
        'trail': {'line': {'color': GREY, 'width': 1.5}},
        'object': {'line': {'color': view.colour, 'width': 2}, 'fill': 'toself'},
        'horizon': {'line': {'color': ORANGE, 'width': 4}},
        'pusher': {'line': {'color': INK, 'width': 1.5}, 'fill': 'toself', 'fillcolor': INK},
    }
    return [
        go.Scatter(
            x=[],
            y=[],
            mode='lines',
            name=part if alone else view.name,
            showlegend=alone or part == 'object',
            **style,
        )
        for part, style in styles.items()
    ]


def _span(views: Sequence[View]) -> tuple[list[float], list[float]]:
    points = np.concatenate([view.reference.pose[:, :2] for view in views]) * 1e3
    low, high = points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
    return [float(low[0]), float(high[0])], [float(low[1]), float(high[1])]


def _frames(view: View) -> dict[str, Any]:
    tracking, reference = view.tracking, view.reference
    chosen = _chosen(tracking.reference_time)
    index, _ = view.run.pusher.at(tracking.stamp[chosen])
    tip = view.run.pusher.values[index] * 1e3 if index.size else np.zeros((0, 2))
    pose = tracking.pose[chosen]
    planned = Horizons.of(view.run.horizons).at(tracking.stamp[chosen]) * 1e3
    return {
        'side': reference.side * 1e3,
        'tip_radius': reference.tip_radius * 1e3,
        'time': _rounded(tracking.reference_time[chosen], 2),
        'x': _rounded(pose[:, 0] * 1e3, 1),
        'y': _rounded(pose[:, 1] * 1e3, 1),
        'theta': _rounded(pose[:, 2], 4),
        'tip_x': _rounded(tip[:, 0], 1),
        'tip_y': _rounded(tip[:, 1], 1),
        'horizon_points': planned.shape[1],
        'horizon_x': _rounded(planned[:, :, 0].ravel(), 1),
        'horizon_y': _rounded(planned[:, :, 1].ravel(), 1),
    }


def _chosen(time: Floats) -> NDArray[np.intp]:
    """The frames (m,) that are shown, evenly spaced in time."""
    if not time.size:
        return np.zeros(0, np.intp)
    count = min(MOST_FRAMES, int((time[-1] - time[0]) * FRAMES_PER_SECOND) + 2)
    wanted = np.linspace(time[0], time[-1], count)
    return np.unique(np.minimum(np.searchsorted(time, wanted), time.size - 1))


def _rounded(values: Floats, digits: int) -> list[float]:
    rounded: list[float] = np.round(values, digits).tolist()
    return rounded
