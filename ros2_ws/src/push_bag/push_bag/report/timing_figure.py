"""Histograms of the times of the control loop."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
import plotly.graph_objects as go
from push_report.figure_style import BLUE, RED, styled

from push_bag.report.reported_run import ReportedRun
from push_bag.run import Floats
from push_bag.score import DEADLINE

BINS = 60
HEIGHT = 340


def timing_figures(runs: Sequence[ReportedRun]) -> list[go.Figure]:
    """Solve, tick and pose-to-command times; the logarithmic counts show the tails."""
    answers = [run.timing.pose_to_command for run in runs]
    figures = [
        _figure('solve', runs, [run.timing.solve for run in runs]),
        _figure('tick', runs, [run.timing.tick for run in runs]),
        _figure('pose to command', runs, answers),
    ]
    if any((each > DEADLINE * 1e3).any() for each in answers):
        _mark(figures[-1], DEADLINE * 1e3, 'deadline')
    return figures


def _figure(name: str, runs: Sequence[ReportedRun], times: Sequence[Floats]) -> go.Figure:
    """The distribution of one time (n,) [ms] of each run."""
    figure = go.Figure()
    figure.update_xaxes(title=f'{name} [ms]', rangemode='tozero')
    figure.update_yaxes(title='ticks')
    styled(figure, HEIGHT, showlegend=False, bargap=0.05)
    if any(each.size for each in times):
        _fill(figure, runs, times)
    else:
        _mark_not_measured(figure)
    return figure


def _fill(figure: go.Figure, runs: Sequence[ReportedRun], times: Sequence[Floats]) -> None:
    edges = np.histogram_bin_edges(np.concatenate(times), BINS)
    counts = [np.histogram(each, edges)[0] for each in times]
    if len(runs) == 1:
        _add_bars(figure, edges, counts[0])
        _mark(figure, float(np.percentile(times[0], 99.0)), 'p99')
    else:
        for run, count in zip(runs, counts, strict=True):
            _add_steps(figure, edges, count, run)
    # from below one tick to above the highest bar, in decades
    decades = [-0.2, np.log10(max(int(count.max()) for count in counts)) + 0.3]
    figure.update_yaxes(type='log', dtick=1, range=decades)


def _mark_not_measured(figure: go.Figure) -> None:
    # an axis exists only once a trace uses it
    figure.add_trace(go.Bar(x=[None], y=[None]))
    figure.update_xaxes(tickvals=[])
    figure.update_yaxes(tickvals=[])
    places = {'xref': 'x domain', 'yref': 'y domain', 'showarrow': False}
    figure.add_annotation(text='not measured', x=0.5, y=0.5, **places)


def _add_bars(figure: go.Figure, edges: Floats, counts: Floats) -> None:
    figure.add_bar(
        x=_middles(edges),
        y=counts,
        marker_color=BLUE,
        hovertemplate='%{x:.2f} ms: %{y}<extra></extra>',
    )


def _add_steps(figure: go.Figure, edges: Floats, counts: Floats, run: ReportedRun) -> None:
    figure.add_scatter(
        x=_middles(edges),
        y=np.where(counts > 0, counts, np.nan),
        mode='lines',
        name=run.name,
        line={'color': run.colour, 'shape': 'hvh'},
        hovertemplate='%{x:.2f} ms: %{y}',
    )


def _middles(edges: Floats) -> Floats:
    return np.array([(low + high) / 2.0 for low, high in pairwise(edges)])


def _mark(figure: go.Figure, time: float, name: str) -> None:
    line = {'color': RED, 'width': 1.5, 'dash': 'dash'}
    figure.add_vline(time, line=line, annotation_text=f'{name} {time:.2f} ms')
