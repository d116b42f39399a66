"""The times of `bench timing` as a page: each solver's share of ticks by the time they took."""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go

from push_bringup.bench.rows import SolverRow


def timing_page(rows: Sequence[SolverRow]) -> str:
    """One HTML file that needs no server."""
    figure = go.Figure()
    for row in rows:
        slower = np.arange(row.milliseconds.size, 0, -1) / row.milliseconds.size
        times = np.sort(row.milliseconds)
        figure.add_scatter(x=times, y=slower, name=row.name, line_shape='hv')
    figure.update_xaxes(title='update and solve, CPU time [ms]', type='log')
    figure.update_yaxes(title='share of ticks that took longer', type='log')
    figure.update_layout(
        title='The quadratic programs of one lap with kicks', template='simple_white'
    )
    return str(figure.to_html(include_plotlyjs=True, full_html=True))
