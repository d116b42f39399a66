"""How long the loop took: histograms with their tails."""

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from push_bag.figure_style import BLUE, RED, styled
from push_bag.series import Floats
from push_bag.timing import DEADLINE, Timing

BINS = 60
HEIGHT = 340


def timing_figure(timing: Timing) -> go.Figure:
    """Solve, tick and pose-to-command times, counted on a logarithmic axis to show the tail."""
    panels = (
        ('solve', timing.solve),
        ('tick', timing.tick),
        ('pose to command', timing.pose_to_command),
    )
    figure = make_subplots(1, len(panels), horizontal_spacing=0.07)
    for column, (name, times) in enumerate(panels, start=1):
        _add_histogram(figure, column, times)
        figure.update_xaxes(title=f'{name} [ms]', rangemode='tozero', row=1, col=column)
    if (timing.pose_to_command > DEADLINE * 1e3).any():
        _mark(figure, len(panels), DEADLINE * 1e3, 'deadline', RED)
    figure.update_yaxes(title='ticks', row=1, col=1)
    return styled(figure, HEIGHT, showlegend=False, bargap=0.05)


def _add_histogram(figure: go.Figure, column: int, times: Floats) -> None:
    if not times.size:
        axes = {'xref': 'x domain', 'yref': 'y domain', 'showarrow': False}
        figure.add_annotation(text='not measured', x=0.5, y=0.5, row=1, col=column, **axes)
        return
    counts, edges = np.histogram(times, BINS)
    bars = go.Bar(
        x=(edges[:-1] + edges[1:]) / 2.0,
        y=counts,
        marker_color=BLUE,
        hovertemplate='%{x:.2f} ms: %{y}<extra></extra>',
    )
    figure.add_trace(bars, row=1, col=column)
    # from below one tick to above the highest bar, in decades
    decades = [-0.2, np.log10(counts.max()) + 0.3]
    figure.update_yaxes(type='log', dtick=1, range=decades, row=1, col=column)
    _mark(figure, column, float(np.percentile(times, 99.0)), 'p99', RED)


def _mark(figure: go.Figure, column: int, time: float, name: str, colour: str) -> None:
    line = {'color': colour, 'width': 1.5, 'dash': 'dash'}
    text = f'{name} {time:.2f} ms'
    figure.add_vline(time, line=line, annotation_text=text, row=1, col=column)
