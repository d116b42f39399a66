"""`bench timing --html`: the share of ticks that took longer than a time, for each solver."""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from push_report.deferred_figure import deferred
from push_report.figure_style import RUN_COLOURS, styled
from push_report.page import page, section, table

from push_bringup.bench.rows import SolverRow

TITLE = 'Times of the QP solvers'
TEXT = (
    'Every solver solves the quadratic programs (QPs) of all ticks of one lap with '
    'perturbations, in their order. The times are CPU time of update and solve in one thread. '
    'The first inputs of each solution are compared with those of an exact solver.'
)
READING = (
    'A curve shows at each time the share of ticks that took longer: where it crosses 0.01 is '
    'p99, its right end is the slowest tick. A tick must be over within 10 ms.'
)
HEADS = ('solver', 'p50', 'p99', 'p99.9', 'max', 'most iterations', 'error of the first input')
HEIGHT = 520


def solver_times_page(rows: Sequence[SolverRow]) -> str:
    """A self-contained HTML page."""
    figure = deferred(_figure(rows), 'times')
    sections = [
        section('Times and errors', table(HEADS, [_cells(row) for row in rows]), TEXT),
        section('Share of ticks that took longer', figure, READING),
    ]
    return page(TITLE, sections)


def _cells(row: SolverRow) -> list[str]:
    figures = row.as_json()
    times = [f'{figures[name]:.3f} ms' for name in ('p50_ms', 'p99_ms', 'p999_ms', 'max_ms')]
    error = f'{1e3 * figures["first_input_error_m_s"]:.3g} mm/s'
    return [row.name, *times, str(figures['iterations_max']), error]


def _figure(rows: Sequence[SolverRow]) -> go.Figure:
    figure = go.Figure()
    for number, row in enumerate(rows):
        slower = np.arange(row.milliseconds.size, 0, -1) / row.milliseconds.size
        times = np.sort(row.milliseconds)
        colour = RUN_COLOURS[number % len(RUN_COLOURS)]
        line = {'color': colour, 'shape': 'hv', 'width': 1.5}
        x, y = times.astype(np.float32), slower.astype(np.float32)
        figure.add_scatter(x=x, y=y, mode='lines', name=row.name, line=line)
    styled(figure, HEIGHT)
    figure.update_xaxes(title='update and solve, CPU time [ms]', type='log', dtick=1)
    return figure.update_yaxes(title='share of ticks', type='log', dtick=1)
