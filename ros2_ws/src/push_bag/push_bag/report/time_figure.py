"""The runs over time: errors, contact and inputs on one linked axis."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_report.figure_style import BLUE, GREEN, GREY, INK, ORANGE, RED, styled

from push_bag.report.pen import Pen
from push_bag.report.view import View
from push_bag.score import loss_intervals, reference_times

Shape = dict[str, Any]  # as plotly takes it

# title of each row, and values that its axis shows in any case: noise shall look like noise
ROWS = (
    ('error [mm]', (0.0, 1.0)),
    ('heading error [deg]', (-1.0, 1.0)),
    ('p_y [mm]', (-5.0, 5.0)),
    ('gap [mm]', (-0.1, 1.0)),
    ('v_n [mm/s]', (0.0, 10.0)),
    ('v_t [mm/s]', (-10.0, 10.0)),
)
CROSS_TRACK = 'cross-track error, left positive'
# the axes' titles explain the other lines
LEGEND = ('tracking error', CROSS_TRACK, 'nominal', 'limited', 'no contact', 'perturbation')
TIME_AXIS = f'x{len(ROWS)}'  # of the lowest row; all rows use it, so the cursor crosses them
HEIGHT = 1100


def time_figure(views: Sequence[View]) -> go.Figure:
    """Errors, contact offset, gap and inputs over reference time, zooming together.

    The first shape of the layout is the time cursor, which `report.js` moves.
    """
    figure = make_subplots(len(ROWS), 1, shared_xaxes=True, vertical_spacing=0.025)
    for view in views:
        pen = Pen(figure, view, alone=len(views) == 1)
        _add_errors(pen)
        _add_contact(pen)
        _add_inputs(pen)
    _mark_events(figure, views)
    _explain(figure, LEGEND if len(views) == 1 else [view.name for view in views])
    styled(figure, HEIGHT, hovermode='x unified')
    for row, (title, shown) in enumerate(ROWS, start=1):
        figure.update_yaxes(
            title=title, autorangeoptions={'include': shown}, nticks=5, row=row, col=1
        )
    figure.update_traces(xaxis=TIME_AXIS)
    figure.update_xaxes(title='reference time [s]', row=len(ROWS), col=1)
    return figure.update_xaxes(showspikes=True, spikemode='across', spikethickness=1)


def _add_errors(pen: Pen) -> None:
    tracking = pen.view.tracking
    time = tracking.reference_time
    pen.line(1, 'tracking error', time, tracking.distance * 1e3, BLUE)
    pen.detail(1, CROSS_TRACK, time, tracking.cross_track * 1e3, ORANGE)
    pen.line(2, 'heading error', time, np.degrees(tracking.heading), GREEN)


def _add_contact(pen: Pen) -> None:
    contact, reference = pen.view.contact, pen.view.reference
    stamps = contact.stamp
    time = reference_times(pen.view.run, stamps) if stamps.size else np.zeros(0)
    pen.line(3, 'contact offset', time, contact.p_y * 1e3, BLUE)
    pen.wanted(3, reference.time, reference.p_y * 1e3)
    pen.line(4, 'gap between tip and face', time, contact.gap * 1e3, BLUE)


def _add_inputs(pen: Pen) -> None:
    run = pen.view.run
    ticks = run.following
    time = run.state('reference_time')[ticks]
    for row, name in ((5, 'v_n'), (6, 'v_t')):
        pen.line(row, f'commanded {name}', time, run.state(name)[ticks] * 1e3, BLUE)
        pen.wanted(row, time, run.state(f'nominal_{name}')[ticks] * 1e3)
    limited = run.state('limited')[ticks] > 0
    pen.marks(5, 'limited', time[limited], run.state('v_n')[ticks][limited] * 1e3)


def _mark_events(figure: go.Figure, views: Sequence[View]) -> None:
    bands = [shape for view in views for shape in _loss_bands(view)]
    lines = [shape for view in views for shape in _disturbance_lines(view)]
    # all at once: adding shapes one by one takes time quadratic in their number
    cursor = _shape('line', 0.0, 0.0, INK) | {'layer': 'above'}
    figure.update_layout(shapes=[cursor, *bands, *lines])
    if bands:
        _add_key(figure, 'no contact', {'symbol': 'square', 'color': GREY, 'size': 10})
    if lines:
        _add_key(figure, 'perturbation', {'symbol': 'line-ns-open', 'color': RED, 'size': 10})


def _loss_bands(view: View) -> list[Shape]:
    """A grey band through all rows for each interval without contact."""
    intervals = np.array(loss_intervals(view.contact), np.int64).reshape(-1, 2)
    if not intervals.size:
        return []
    times = reference_times(view.run, intervals.ravel()).reshape(-1, 2)
    return [_shape('rect', start, end, GREY) for start, end in times.tolist()]


def _disturbance_lines(view: View) -> list[Shape]:
    """A red line through all rows for each perturbation."""
    if not view.contact.stamp.size:
        return []
    stamps = np.array([each.stamp for each in view.run.disturbances], np.int64)
    return [_shape('line', time, time, RED) for time in reference_times(view.run, stamps).tolist()]


def _shape(kind: str, start: float, end: float, colour: str) -> Shape:
    return {
        'type': kind,
        'xref': TIME_AXIS,
        'yref': 'paper',
        'x0': start,
        'x1': end,
        'y0': 0.0,
        'y1': 1.0,
        'layer': 'below',
        'fillcolor': colour,
        'opacity': 0.4,
        'line': {'color': colour, 'width': 1.5},
    }


def _add_key(figure: go.Figure, name: str, marker: dict[str, object]) -> None:
    """A trace without points, which gives a shape its place in the legend."""
    key = go.Scatter(x=[None], y=[None], mode='markers', name=name, marker=marker)
    figure.add_trace(key, row=1, col=1)


def _explain(figure: go.Figure, names: Sequence[str]) -> None:
    """Leaves each of the names in the legend once, and no other."""
    figure.update_traces(showlegend=False)
    for name in names:
        for trace in list(figure.select_traces({'name': name}))[:1]:
            trace.showlegend = True
