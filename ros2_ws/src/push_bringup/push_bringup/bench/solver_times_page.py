"""`bench timing --html`: the share of ticks that took longer than a time, for each solver."""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go

from push_bringup.bench.rows import SolverRow


def solver_times_page(rows: Sequence[SolverRow]) -> str:
    """A self-contained HTML page."""
    figure = go.Figure()
    for row in rows:
        slower = np.arange(row.milliseconds.size, 0, -1) / row.milliseconds.size
        times = np.sort(row.milliseconds)
        figure.add_scatter(x=times, y=slower, name=row.name, line_shape='hv')
    figure.update_xaxes(title='update and solve, CPU time [ms]', type='log')
    figure.update_yaxes(title='share of ticks that took longer', type='log')
    figure.update_layout(title='The QPs of one lap with perturbations', template='simple_white')
    return str(figure.to_html(include_plotlyjs=True, full_html=True))
