"""Errors, contact and inputs over time, on one linked axis."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_report.figure_style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    RED,
    ROBUST_END,
    robust_limit,
    styled,
)

from push_bag.report.prediction import disturbances, prediction_errors, tip_velocities
from push_bag.report.reported_run import ReportedRun
from push_bag.report.run_lines import RunLines
from push_bag.score import loss_intervals, reference_times

Shape = dict[str, Any]  # as plotly takes it

# title of each row, and values that its axis always includes, so that noise looks small
ROWS = (
    ('error [mm]', (0.0, 1.0)),
    ('heading [deg]', (-1.0, 1.0)),
    ('p_y [mm]', (-5.0, 5.0)),
    ('gap [mm]', (-0.1, 1.0)),
    ('v_n [mm/s]', (0.0, 10.0)),
    ('v_t [mm/s]', (-10.0, 10.0)),
    ('prediction [mm]', (0.0, 0.5)),
    ('model error [%]', (-1.0, 1.0)),
    ('turn [deg/m]', (-5.0, 5.0)),
)
ERROR, HEADING, CONTACT, GAP, V_N, V_T, PREDICTION, MODEL, TURN = range(1, len(ROWS) + 1)
CROSS_TRACK = 'cross-track error, left positive'
MEASURED, ALONG, ACROSS = 'measured tip', 'model error along the push', 'model error across'
# the other lines are named by the titles of their axes
LEGEND = (
    *('tracking error', CROSS_TRACK, 'nominal', MEASURED, 'limited', ALONG, ACROSS),
    *('no contact', 'perturbation'),
)
TIME_AXIS = f'x{len(ROWS)}'  # of the lowest row, for all rows: the cursor crosses them
HEIGHT = 1560
TEXT = (
    f'Axes end at {ROBUST_END} of what they show, so that one perturbation does not flatten the '
    'rest; a double click on an axis shows all. v_n and v_t: commanded velocity of the tip, and '
    'measured over 40 ms. Prediction error: from the predicted centre of the object, at the '
    'instant when a command takes effect, to the measured one. Model error: what the controller '
    'estimates that its model misses, per metre of tip travel.'
)


def time_figure(runs: Sequence[ReportedRun]) -> go.Figure:
    """Errors, contact offset, gap and inputs over reference time; all rows zoom together.

    The first shape of the layout is the time cursor, which `report.js` moves.
    """
    figure = make_subplots(len(ROWS), 1, shared_xaxes=True, vertical_spacing=0.025)
    for run in runs:
        lines = RunLines(figure, run, alone=len(runs) == 1)
        _add_errors(lines)
        _add_contact(lines)
        _add_inputs(lines)
        _add_model(lines)
    _mark_events(figure, runs)
    _limit_legend(figure, LEGEND if len(runs) == 1 else [run.name for run in runs])
    styled(figure, HEIGHT, hovermode='x unified')
    for row, (title, shown) in enumerate(ROWS, start=1):
        figure.update_yaxes(
            title=title, range=_robust_range(figure, row, shown), nticks=5, row=row, col=1
        )
    figure.update_traces(xaxis=TIME_AXIS)
    figure.update_xaxes(title='reference time [s]', row=len(ROWS), col=1)
    return figure.update_xaxes(showspikes=True, spikemode='across', spikethickness=1)


def _add_errors(lines: RunLines) -> None:
    tracking = lines.run.tracking
    time = tracking.reference_time
    lines.line(ERROR, 'tracking error', time, tracking.distance * 1e3, BLUE)
    lines.detail(ERROR, CROSS_TRACK, time, tracking.cross_track * 1e3, ORANGE)
    lines.line(HEADING, 'heading error', time, np.degrees(tracking.heading), GREEN)


def _add_contact(lines: RunLines) -> None:
    contact, reference = lines.run.contact, lines.run.reference
    stamps = contact.stamp
    time = reference_times(lines.run.series, stamps) if stamps.size else np.zeros(0)
    lines.line(CONTACT, 'contact offset', time, contact.p_y * 1e3, BLUE)
    lines.nominal(CONTACT, reference.time, reference.p_y * 1e3)
    lines.line(GAP, 'gap between tip and face', time, contact.gap * 1e3, BLUE)


def _add_inputs(lines: RunLines) -> None:
    run = lines.run.series
    ticks = run.following
    time = run.state('reference_time')[ticks]
    tip_time, tip = tip_velocities(run)
    for axis, (row, name) in enumerate(((V_N, 'v_n'), (V_T, 'v_t'))):
        lines.detail(row, MEASURED, tip_time, tip[:, axis] * 1e3, ORANGE)
        lines.line(row, f'commanded {name}', time, run.state(name)[ticks] * 1e3, BLUE)
        lines.nominal(row, time, run.state(f'nominal_{name}')[ticks] * 1e3)
    limited = run.state('limited')[ticks] > 0
    lines.marks(V_N, 'limited', time[limited], run.state('v_n')[ticks][limited] * 1e3)


def _add_model(lines: RunLines) -> None:
    run = lines.run.series
    time, errors = prediction_errors(run, lines.run.reference)
    lines.line(PREDICTION, 'prediction error', time, errors * 1e3, BLUE)
    time, rates = disturbances(run)
    lines.line(MODEL, ALONG, time, rates[:, 0] * 1e2, BLUE)
    lines.detail(MODEL, ACROSS, time, rates[:, 1] * 1e2, ORANGE)
    lines.line(TURN, 'turn', time, np.degrees(rates[:, 2]), GREEN)


def _robust_range(figure: go.Figure, row: int, shown: tuple[float, float]) -> list[float]:
    """The range of a row's axis: its values, as far as `robust_limit` of their distances."""
    lines = [np.asarray(each.y, np.float64) for each in figure.select_traces(row=row, col=1)]
    values = np.concatenate([np.zeros(0), *lines])
    values = values[np.isfinite(values)]
    middle = float(np.median(values)) if values.size else 0.0
    reach = robust_limit(np.abs(values - middle), 0.0)
    low = min(shown[0], max(float(values.min(initial=middle)), middle - reach))
    high = max(shown[1], min(float(values.max(initial=middle)), middle + reach))
    margin = 0.05 * (high - low)
    return [low - margin, high + margin]


def _mark_events(figure: go.Figure, runs: Sequence[ReportedRun]) -> None:
    bands = [shape for run in runs for shape in _loss_bands(run)]
    lines = [shape for run in runs for shape in _perturbation_lines(run)]
    # in one call: adding shapes one by one takes quadratic time
    cursor = _shape('line', 0.0, 0.0, INK) | {'layer': 'above'}
    figure.update_layout(shapes=[cursor, *bands, *lines])
    if bands:
        _add_key(figure, 'no contact', {'symbol': 'square', 'color': GREY, 'size': 10})
    if lines:
        _add_key(figure, 'perturbation', {'symbol': 'line-ns-open', 'color': RED, 'size': 10})


def _loss_bands(run: ReportedRun) -> list[Shape]:
    """A grey band across all rows for each interval without contact."""
    intervals = np.array(loss_intervals(run.contact), np.int64).reshape(-1, 2)
    if not intervals.size:
        return []
    times = reference_times(run.series, intervals.ravel()).reshape(-1, 2)
    return [_shape('rect', start, end, GREY) for start, end in times.tolist()]


def _perturbation_lines(run: ReportedRun) -> list[Shape]:
    """A red line across all rows for each perturbation."""
    if not run.contact.stamp.size:
        return []
    stamps = np.array([each.stamp for each in run.series.perturbations], np.int64)
    return [
        _shape('line', time, time, RED) for time in reference_times(run.series, stamps).tolist()
    ]


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
    """Adds a trace without points as the legend entry of a shape."""
    key = go.Scatter(x=[None], y=[None], mode='markers', name=name, marker=marker)
    figure.add_trace(key, row=1, col=1)


def _limit_legend(figure: go.Figure, names: Sequence[str]) -> None:
    """Shows each of the names once in the legend, and no others."""
    figure.update_traces(showlegend=False)
    for name in names:
        for trace in list(figure.select_traces({'name': name}))[:1]:
            trace.showlegend = True
