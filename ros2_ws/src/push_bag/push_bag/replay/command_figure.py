"""An HTML page of recorded and recomputed commands; works offline."""

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from push_bag.replay.recompute import Recomputed

TITLES = ('v_x [mm/s]', 'v_y [mm/s]', 'difference [mm/s]')


def command_page(run: Recomputed) -> str:
    """The figure as an HTML page."""
    return str(command_figure(run).to_html(include_plotlyjs=True, full_html=True))


def command_figure(run: Recomputed) -> go.Figure:
    """Both components of the commanded velocity over time, and the size of the difference."""
    figure = make_subplots(rows=3, cols=1, shared_xaxes=True, subplot_titles=TITLES)
    time = (run.stamp - run.stamp[:1].sum()) * 1e-9
    for axis in range(2):
        for name, values, dash in (
            ('recorded', run.recorded, 'solid'),
            ('recomputed', run.computed, 'dot'),
        ):
            line = go.Scatter(
                x=time,
                y=1e3 * values[:, axis],
                name=name,
                line={'dash': dash},
                legendgroup=name,
                showlegend=axis == 0,
            )
            figure.add_trace(line, row=axis + 1, col=1)
    difference = 1e3 * np.hypot(*(run.computed - run.recorded).T)
    figure.add_trace(go.Scatter(x=time, y=difference, name='difference'), row=3, col=1)
    figure.update_xaxes(title_text='time since the first command [s]', row=3, col=1)
    figure.update_layout(height=800, title='Recorded and recomputed commands')
    return figure
