"""The lap to scale: reference, path coloured by its error, outlines of the square.

Several runs are drawn as one line each; their errors are then told by the figure over time.
"""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from push_report.figure_style import GREY, INK, LOW_TO_HIGH, PALE, RED, styled, thinned

from push_bag.report.view import View
from push_bag.run import Disturbance, Floats, Reference
from push_bag.score import Tracking

OUTLINES = 16
LEAST_COLOUR_RANGE = 0.5  # [mm], so that a perfect lap does not show its noise
HEIGHT = 720
MOST_MARKERS = 1500  # each is an element of the page, and takes as long to draw as ten of a line


def lap_figure(views: Sequence[View]) -> go.Figure:
    """The laps in the world frame, axes in millimetres at one scale."""
    figure = go.Figure()
    traces = _alone(views[0]) if len(views) == 1 else _together(views)
    for trace in traces:
        figure.add_trace(trace)
    styled(figure, HEIGHT, hovermode='closest')
    figure.update_xaxes(title='x [mm]')
    figure.update_yaxes(title='y [mm]', scaleanchor='x', scaleratio=1.0)
    return figure


def _alone(view: View) -> list[go.Scatter]:
    return [
        _outlines(view.tracking, view.reference.side),
        _reference(view.reference),
        _path(view.tracking),
        _start(view.reference),
        _kicks(view.tracking, view.run.disturbances),
    ]


def _together(views: Sequence[View]) -> list[go.Scatter]:
    # runs of one report mostly share their track; the first one's is drawn
    return [_reference(views[0].reference), *(_line(view) for view in views)]


def _line(view: View) -> go.Scatter:
    x, y, time = thinned(
        view.tracking.pose[:, 0] * 1e3,
        view.tracking.pose[:, 1] * 1e3,
        view.tracking.reference_time,
    )
    return go.Scatter(
        x=x,
        y=y,
        mode='lines',
        name=view.name,
        customdata=time[:, None],
        hovertemplate='t = %{customdata[0]:.2f} s<extra></extra>',
        line={'color': view.colour, 'width': 1.5},
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
            'cmax': max(float(error.max(initial=0.0)), LEAST_COLOUR_RANGE),
            'colorscale': LOW_TO_HIGH,
            'colorbar': {'title': {'text': 'tracking error [mm]', 'side': 'right'}, 'len': 0.8},
        },
    )


def _outlines(tracking: Tracking, side: float) -> go.Scatter:
    """The square at some instants, as one line with gaps."""
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
    """Closed outline (6, 2) [m] of the square at a pose (3,), ending in a gap."""
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


def _kicks(tracking: Tracking, disturbances: tuple[Disturbance, ...]) -> go.Scatter:
    stamps = np.array([each.stamp for each in disturbances], np.int64)
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
