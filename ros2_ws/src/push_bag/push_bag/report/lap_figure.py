"""The lap to scale: reference, path coloured by tracking error, outlines of the square.

Several runs are drawn as one line each, without colour for the error.
"""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from push_report.figure_style import (
    GREY,
    INK,
    LOW_TO_HIGH,
    MOST_MARKERS,
    PALE,
    RED,
    ROBUST_END,
    robust_limit,
    styled,
    thinned,
)

from push_bag.report.reported_run import ReportedRun
from push_bag.run import Floats, PerturbationEvent, Reference
from push_bag.score import Tracking

OUTLINES = 16
LEAST_COLOUR_RANGE = 0.5  # [mm]; with less, a good lap would show its noise
HEIGHT = 720
TEXT = (
    f'Colours end at {ROBUST_END} of the tracking error; where it is larger, as after a '
    'perturbation, the path has the last colour.'
)


def lap_figure(runs: Sequence[ReportedRun]) -> go.Figure:
    """The laps in the world frame, axes in millimetres at one scale."""
    figure = go.Figure()
    traces = _alone(runs[0]) if len(runs) == 1 else _together(runs)
    for trace in traces:
        figure.add_trace(trace)
    styled(figure, HEIGHT, hovermode='closest')
    figure.update_xaxes(title='x [mm]')
    figure.update_yaxes(title='y [mm]', scaleanchor='x', scaleratio=1.0)
    return figure


def _alone(run: ReportedRun) -> list[go.Scatter]:
    return [
        _outlines(run.tracking, run.reference.side),
        _reference(run.reference),
        _path(run.tracking),
        _start(run.reference),
        _perturbations(run.tracking, run.series.perturbations),
    ]


def _together(runs: Sequence[ReportedRun]) -> list[go.Scatter]:
    # runs of one report mostly share the track, so only the first reference is drawn
    return [_reference(runs[0].reference), *(_line(run) for run in runs)]


def _line(run: ReportedRun) -> go.Scatter:
    x, y, time = thinned(
        run.tracking.pose[:, 0] * 1e3,
        run.tracking.pose[:, 1] * 1e3,
        run.tracking.reference_time,
    )
    return go.Scatter(
        x=x,
        y=y,
        mode='lines',
        name=run.name,
        customdata=time[:, None],
        hovertemplate='t = %{customdata[0]:.2f} s<extra></extra>',
        line={'color': run.colour, 'width': 1.5},
    )


def _reference(reference: Reference) -> go.Scatter:
    x, y = thinned(reference.pose[:, 0] * 1e3, reference.pose[:, 1] * 1e3)
    return go.Scatter(
        x=x, y=y, mode='lines', name='reference', line={'color': INK, 'width': 1.5, 'dash': 'dot'}
    )


def _path(tracking: Tracking) -> go.Scatter:
    x, y, error, time = thinned(
        tracking.pose[:, 0] * 1e3,
        tracking.pose[:, 1] * 1e3,
        tracking.distance * 1e3,
        tracking.reference_time,
        most=MOST_MARKERS,
    )
    return go.Scatter(
        x=x,
        y=y,
        mode='markers',
        name='path of the object',
        customdata=np.stack([time, error], axis=1),
        hovertemplate='t = %{customdata[0]:.2f} s<br>error %{customdata[1]:.2f} mm<extra></extra>',
        marker={
            'size': 5,
            'color': error,
            'cmin': 0.0,
            'cmax': robust_limit(error, LEAST_COLOUR_RANGE),
            'colorscale': LOW_TO_HIGH,
            'colorbar': {'title': {'text': 'tracking error [mm]', 'side': 'right'}, 'len': 0.8},
        },
    )


def _outlines(tracking: Tracking, side: float) -> go.Scatter:
    """The square at OUTLINES instants, as one line with gaps."""
    count = min(OUTLINES, tracking.stamp.size)
    chosen = np.linspace(0, max(tracking.stamp.size - 1, 0), count).astype(np.intp)
    corners = [_corners(tracking.pose[index], side) for index in chosen]
    points = np.concatenate(corners) * 1e3 if corners else np.zeros((0, 2))
    return go.Scatter(
        x=points[:, 0].astype(np.float32),
        y=points[:, 1].astype(np.float32),
        mode='lines',
        name='outline of the object',
        hoverinfo='skip',
        line={'color': PALE, 'width': 1.2},
    )


def _corners(pose: Floats, side: float) -> Floats:
    """Closed outline (6, 2) [m] of the square at a pose (3,); the last row is NaN, a gap."""
    half = side / 2.0
    square = np.array([[-half, -half], [half, -half], [half, half], [-half, half], [-half, -half]])
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    outline = square @ np.array([[cos, sin], [-sin, cos]]) + pose[:2]
    return np.concatenate([outline, np.full((1, 2), np.nan)])


def _start(reference: Reference) -> go.Scatter:
    return go.Scatter(
        x=[float(reference.pose[0, 0]) * 1e3],
        y=[float(reference.pose[0, 1]) * 1e3],
        mode='markers',
        name='start',
        marker={
            'symbol': 'diamond',
            'size': 11,
            'color': 'white',
            'line': {'color': INK, 'width': 2},
        },
    )


def _perturbations(tracking: Tracking, perturbations: tuple[PerturbationEvent, ...]) -> go.Scatter:
    stamps = np.array([each.stamp for each in perturbations], np.int64)
    stamps = stamps[: stamps.size if tracking.stamp.size else 0]
    index = np.minimum(np.searchsorted(tracking.stamp, stamps), max(tracking.stamp.size - 1, 0))
    points = tracking.pose[index, :2] * 1e3
    return go.Scatter(
        x=points[:, 0],
        y=points[:, 1],
        mode='markers',
        name='perturbation',
        visible=bool(stamps.size),
        marker={'symbol': 'x', 'size': 12, 'color': RED, 'line': {'color': GREY, 'width': 0.5}},
    )
