"""An HTML page of recorded and recomputed commands; works offline."""

import numpy as np
import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_report.deferred_figure import deferred
from push_report.figure_style import BLUE, ORANGE, RED, styled, thinned
from push_report.page import page, section

from push_bag.replay.recompute import Recomputed

TITLE = 'Recorded and recomputed commands'
TEXT = (
    'The controller is given the recorded poses and times of every tick again. Where the '
    'recomputed velocity of the tip, in the world frame, is not the recorded one bit for bit, '
    'parameters, model, code or libraries differ from those of the run.'
)
ROWS = ('v_x [mm/s]', 'v_y [mm/s]', 'difference [mm/s]')
HEIGHT = 800


def command_page(run: Recomputed) -> str:
    """The page: the comparison in words and as a figure."""
    words = section('', f'<pre>{run.text()}</pre>', TEXT)
    return page(TITLE, [words, section('Over time', deferred(command_figure(run), 'commands'))])


def command_figure(run: Recomputed) -> go.Figure:
    """Both components of the commanded velocity over time, and the size of the difference."""
    figure = make_subplots(rows=3, cols=1, shared_xaxes=True, vertical_spacing=0.04)
    time = (run.stamp - run.stamp[:1].sum()) * 1e-9
    for name, values, style in (
        ('recorded', run.recorded, {'color': BLUE, 'width': 1.5}),
        ('recomputed', run.computed, {'color': ORANGE, 'width': 1.5, 'dash': 'dot'}),
    ):
        for axis in range(2):
            _line(figure, axis + 1, name, time, values[:, axis], style)
    difference = np.hypot(*(run.computed - run.recorded).T)
    _line(figure, 3, 'difference', time, difference, {'color': RED, 'width': 1.5})
    styled(figure, HEIGHT, hovermode='x unified')
    for row, title in enumerate(ROWS, start=1):
        figure.update_yaxes(title=title, row=row, col=1)
    return figure.update_xaxes(title='time since the first command [s]', row=3, col=1)


def _line(
    figure: go.Figure,
    row: int,
    name: str,
    time: np.ndarray,
    values: np.ndarray,
    style: dict[str, object],
) -> None:
    """Adds values (n,) [m/s] over times (n,) [s]; the first row gives the legend."""
    x, y = thinned(time, 1e3 * values)
    shown = row != 2
    line = go.Scatter(x=x, y=y, mode='lines', name=name, line=style, showlegend=shown)
    figure.add_trace(line, row=row, col=1)
