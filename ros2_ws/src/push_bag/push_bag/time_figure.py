"""The run over time: errors, contact and inputs on one linked axis."""

from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_msgs.msg import ControllerState

from push_bag.contact import Contact, loss_intervals
from push_bag.figure_style import BLUE, GREEN, GREY, INK, ORANGE, RED, styled, thinned
from push_bag.series import Floats, Reference, RunSeries
from push_bag.tracking import Tracking, reference_times

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
NOMINAL = 'nominal'
CROSS_TRACK = 'cross-track error, left positive'
# the axes' titles explain the other lines
LEGEND = ('tracking error', CROSS_TRACK, NOMINAL, 'limited', 'no contact', 'perturbation')
TIME_AXIS = f'x{len(ROWS)}'  # of the lowest row; all rows use it, so the cursor crosses them
HEIGHT = 1100


def time_figure(
    run: RunSeries, reference: Reference, tracking: Tracking, contact: Contact
) -> go.Figure:
    """Errors, contact offset, gap and inputs over reference time, zooming together."""
    figure = make_subplots(len(ROWS), 1, shared_xaxes=True, vertical_spacing=0.025)
    _add_errors(figure, tracking)
    _add_contact(figure, run, reference, contact)
    _add_inputs(figure, run)
    _mark_events(figure, run, contact)
    _explain(figure)
    styled(figure, HEIGHT, hovermode='x unified')
    for row, (title, shown) in enumerate(ROWS, start=1):
        figure.update_yaxes(
            title=title, autorangeoptions={'include': shown}, nticks=5, row=row, col=1
        )
    figure.update_traces(xaxis=TIME_AXIS)
    figure.update_xaxes(title='reference time [s]', row=len(ROWS), col=1)
    return figure.update_xaxes(showspikes=True, spikemode='across', spikethickness=1)


def _add_errors(figure: go.Figure, tracking: Tracking) -> None:
    time = tracking.reference_time
    _line(figure, 1, 'tracking error', time, tracking.distance * 1e3, BLUE)
    _line(figure, 1, CROSS_TRACK, time, tracking.cross_track * 1e3, ORANGE)
    _line(figure, 2, 'heading error', time, np.degrees(tracking.heading), GREEN)


def _add_contact(
    figure: go.Figure, run: RunSeries, reference: Reference, contact: Contact
) -> None:
    time = reference_times(run, contact.stamp) if contact.stamp.size else np.zeros(0)
    _line(figure, 3, 'contact offset', time, contact.p_y * 1e3, BLUE)
    _line(figure, 3, NOMINAL, reference.time, reference.p_y * 1e3, INK, 'dot')
    _line(figure, 4, 'gap between tip and face', time, contact.gap * 1e3, BLUE)


def _add_inputs(figure: go.Figure, run: RunSeries) -> None:
    ticks = run.state('mode') == ControllerState.TRACKING
    time = run.state('reference_time')[ticks]
    for row, name in ((5, 'v_n'), (6, 'v_t')):
        speed = run.state(name)[ticks] * 1e3
        nominal = run.state(f'nominal_{name}')[ticks] * 1e3
        _line(figure, row, f'commanded {name}', time, speed, BLUE)
        _line(figure, row, NOMINAL, time, nominal, INK, 'dot')
    _add_limited(figure, time, run.state('v_n')[ticks] * 1e3, run.state('limited')[ticks])


def _add_limited(figure: go.Figure, time: Floats, speed: Floats, bits: Floats) -> None:
    limited = bits > 0
    if not limited.any():
        return
    x, y = thinned(time[limited], speed[limited])
    marks = go.Scatter(x=x, y=y, mode='markers', name='limited', marker={'color': RED, 'size': 5})
    figure.add_trace(marks, row=5, col=1)


def _loss_bands(run: RunSeries, contact: Contact) -> list[Shape]:
    """A grey band through all rows for each interval without contact."""
    intervals = np.array(loss_intervals(contact), np.int64).reshape(-1, 2)
    if not intervals.size:
        return []
    times = reference_times(run, intervals.ravel()).reshape(-1, 2)
    return [_shape('rect', start, end, GREY) for start, end in times.tolist()]


def _disturbance_lines(run: RunSeries, contact: Contact) -> list[Shape]:
    """A red line through all rows for each perturbation."""
    if not contact.stamp.size:
        return []
    stamps = np.array([each.stamp for each in run.disturbances], np.int64)
    return [_shape('line', time, time, RED) for time in reference_times(run, stamps).tolist()]


def _mark_events(figure: go.Figure, run: RunSeries, contact: Contact) -> None:
    bands, lines = _loss_bands(run, contact), _disturbance_lines(run, contact)
    # all at once: adding shapes one by one takes time quadratic in their number
    figure.update_layout(shapes=bands + lines)
    if bands:
        _add_key(figure, 'no contact', {'symbol': 'square', 'color': GREY, 'size': 10})
    if lines:
        _add_key(figure, 'perturbation', {'symbol': 'line-ns-open', 'color': RED, 'size': 10})


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


def _explain(figure: go.Figure) -> None:
    """Leaves each name of LEGEND in the legend once, and no other."""
    figure.update_traces(showlegend=False)
    for name in LEGEND:
        for trace in list(figure.select_traces({'name': name}))[:1]:
            trace.showlegend = True


def _line(
    figure: go.Figure,
    row: int,
    name: str,
    time: Floats,
    values: Floats,
    colour: str,
    dash: str = 'solid',
) -> None:
    x, y = thinned(time, values)
    line = {'color': colour, 'width': 1.5, 'dash': dash}
    trace = go.Scatter(
        x=x,
        y=y,
        mode='lines',
        name=name,
        line=line,
        hovertemplate='%{y:.2f}',
    )
    figure.add_trace(trace, row=row, col=1)
