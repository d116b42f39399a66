"""The report's animation of the square, the tip and the planned horizon.

The figure holds the reference and empty traces, which `report.js` fills from the data written
here: FRAMES_PER_SECOND frames per second, rounded to tenths of a millimetre.
"""

import json
from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from numpy.typing import NDArray
from push_report.figure_style import GREY, INK, ORANGE, styled, thinned

from push_bag.report.reported_run import ReportedRun
from push_bag.run import Floats, Horizons

FRAMES_PER_SECOND = 25.0
MOST_FRAMES = 4000
HEIGHT = 620
MARGIN = 80.0  # [mm] round the reference; the square reaches out 64 mm


def animation_figure(runs: Sequence[ReportedRun]) -> go.Figure:
    """The references, and for each run four empty traces that `report.js` fills."""
    figure = go.Figure()
    for run in runs:
        figure.add_trace(_reference(run))
    for run in runs:
        for trace in _moving(run, alone=len(runs) == 1):
            figure.add_trace(trace)
    styled(figure, HEIGHT, hovermode=False)
    x, y = _span(runs)
    figure.update_xaxes(title='x [mm]', range=x)
    return figure.update_yaxes(title='y [mm]', range=y, scaleanchor='x', scaleratio=1.0)


def animation_data(runs: Sequence[ReportedRun]) -> str:
    """The frames of all runs for `report.js`, as JSON."""
    data = {
        'first_trace': len(runs),
        'duration': max(run.reference.duration for run in runs),
        'runs': [_frames(run) for run in runs],
    }
    return json.dumps(data, separators=(',', ':'))


def _reference(run: ReportedRun) -> go.Scatter:
    x, y = thinned(run.reference.pose[:, 0] * 1e3, run.reference.pose[:, 1] * 1e3)
    line = {'color': INK, 'width': 1.2, 'dash': 'dot'}
    return go.Scatter(x=x, y=y, mode='lines', name='reference', line=line, showlegend=False)


def _moving(run: ReportedRun, alone: bool) -> list[go.Scatter]:
    styles: dict[str, dict[str, Any]] = {
        'trail': {'line': {'color': GREY, 'width': 1.5}},
        'object': {'line': {'color': run.colour, 'width': 2}, 'fill': 'toself'},
        'horizon': {'line': {'color': ORANGE, 'width': 4}},
        'pusher': {'line': {'color': INK, 'width': 1.5}, 'fill': 'toself', 'fillcolor': INK},
    }
    return [
        go.Scatter(
            x=[],
            y=[],
            mode='lines',
            name=part if alone else run.name,
            showlegend=alone or part == 'object',
            **style,
        )
        for part, style in styles.items()
    ]


def _span(runs: Sequence[ReportedRun]) -> tuple[list[float], list[float]]:
    points = np.concatenate([run.reference.pose[:, :2] for run in runs]) * 1e3
    low, high = points.min(axis=0) - MARGIN, points.max(axis=0) + MARGIN
    return [float(low[0]), float(high[0])], [float(low[1]), float(high[1])]


def _frames(run: ReportedRun) -> dict[str, Any]:
    tracking, reference = run.tracking, run.reference
    chosen = _chosen(tracking.reference_time)
    index, _ = run.series.pusher.near(tracking.stamp[chosen])
    tip = run.series.pusher.values[index] * 1e3 if index.size else np.zeros((0, 2))
    pose = tracking.pose[chosen]
    planned = Horizons.of(run.series.horizons).at(tracking.stamp[chosen]) * 1e3
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
    """Indices (m,) of the frames, evenly spaced in time."""
    if not time.size:
        return np.zeros(0, np.intp)
    count = min(MOST_FRAMES, int((time[-1] - time[0]) * FRAMES_PER_SECOND) + 2)
    instants = np.linspace(time[0], time[-1], count)
    return np.unique(np.minimum(np.searchsorted(time, instants), time.size - 1))


def _rounded(values: Floats, digits: int) -> list[float]:
    rounded: list[float] = np.round(values, digits).tolist()
    return rounded
