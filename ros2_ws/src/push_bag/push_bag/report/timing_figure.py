"""Histograms of the times of the control loop."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_report.figure_style import BLUE, RED, styled

from push_bag.report.reported_run import ReportedRun
from push_bag.run import Floats
from push_bag.score import DEADLINE

BINS = 60
HEIGHT = 340
PANELS = ('solve', 'tick', 'pose to command')


def timing_figure(runs: Sequence[ReportedRun]) -> go.Figure:
    """Solve, tick and pose-to-command times; the logarithmic counts show the tails."""
    figure = make_subplots(1, len(PANELS), horizontal_spacing=0.07)
    for column, name in enumerate(PANELS, start=1):
        _fill_panel(figure, column, runs)
        figure.update_xaxes(title=f'{name} [ms]', rangemode='tozero', row=1, col=column)
    if any((run.timing.pose_to_command > DEADLINE * 1e3).any() for run in runs):
        _mark(figure, len(PANELS), DEADLINE * 1e3, 'deadline', RED)
    figure.update_yaxes(title='ticks', row=1, col=1)
    return styled(figure, HEIGHT, showlegend=False, bargap=0.05)


def _fill_panel(figure: go.Figure, column: int, runs: Sequence[ReportedRun]) -> None:
    times = [_times(run)[column - 1] for run in runs]
    if not any(each.size for each in times):
        _mark_not_measured(figure, column)
        return
    edges = np.histogram_bin_edges(np.concatenate(times), BINS)
    counts = [np.histogram(each, edges)[0] for each in times]
    if len(runs) == 1:
        _add_bars(figure, column, edges, counts[0])
        _mark(figure, column, float(np.percentile(times[0], 99.0)), 'p99', RED)
    else:
        for run, count in zip(runs, counts, strict=True):
            _add_steps(figure, column, edges, count, run)
    # from below one tick to above the highest bar, in decades
    decades = [-0.2, np.log10(max(int(count.max()) for count in counts)) + 0.3]
    figure.update_yaxes(type='log', dtick=1, range=decades, row=1, col=column)


def _mark_not_measured(figure: go.Figure, column: int) -> None:
    # an axis exists only once a trace uses it
    figure.add_trace(go.Bar(x=[None], y=[None]), row=1, col=column)
    for axes in (figure.update_xaxes, figure.update_yaxes):
        axes(tickvals=[], row=1, col=column)
    places = {'xref': _domain('x', column), 'yref': _domain('y', column), 'showarrow': False}
    figure.add_annotation(text='not measured', x=0.5, y=0.5, **places)


def _domain(axis: str, column: int) -> str:
    """Plotly's name for the extent of a panel's axis; the first has no number."""
    return f'{axis}{column if column > 1 else ""} domain'


def _times(run: ReportedRun) -> tuple[Floats, Floats, Floats]:
    """Times [ms] of each of PANELS."""
    return run.timing.solve, run.timing.tick, run.timing.pose_to_command


def _add_bars(figure: go.Figure, column: int, edges: Floats, counts: Floats) -> None:
    bars = go.Bar(
        x=_middles(edges),
        y=counts,
        marker_color=BLUE,
        hovertemplate='%{x:.2f} ms: %{y}<extra></extra>',
    )
    figure.add_trace(bars, row=1, col=column)


def _add_steps(
    figure: go.Figure, column: int, edges: Floats, counts: Floats, run: ReportedRun
) -> None:
    steps = go.Scatter(
        x=_middles(edges),
        y=np.where(counts > 0, counts, np.nan),
        mode='lines',
        name=run.name,
        line={'color': run.colour, 'shape': 'hvh'},
        hovertemplate='%{x:.2f} ms: %{y}',
    )
    figure.add_trace(steps, row=1, col=column)


def _middles(edges: Floats) -> Floats:
    return np.array([(low + high) / 2.0 for low, high in pairwise(edges)])


def _mark(figure: go.Figure, column: int, time: float, name: str, colour: str) -> None:
    line = {'color': colour, 'width': 1.5, 'dash': 'dash'}
    text = f'{name} {time:.2f} ms'
    figure.add_vline(time, line=line, annotation_text=text, row=1, col=column)
