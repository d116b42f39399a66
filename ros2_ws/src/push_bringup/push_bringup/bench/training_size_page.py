"""`bench data --html`: error and share of completed laps over the training size."""

from collections.abc import Sequence

import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_report.deferred_figure import deferred
from push_report.figure_style import INK, RUN_COLOURS, styled
from push_report.page import page, section

from push_bringup.bench.rows import SizeRow
from push_bringup.experiment import Lap

HEIGHT = 760
TEXT = (
    'Mean tracking error of the laps that were completed, and the share of laps that were, over '
    'the number of pushes that the model was trained on. Points are medians over training sets '
    'drawn at random, bars reach from the lower to the upper quartile. "random" draws pushes '
    'from a large set; "die" is the smallest set of the paper, five pushes in the pattern of '
    'the five of a die: one at the middle of the face along its normal, four half-way to its '
    'ends, 30 degrees to either side.'
)


def training_size_page(rows: Sequence[SizeRow], analytical: Lap) -> str:
    """The page; a horizontal line is the analytical controller's error."""
    figure = make_subplots(2, 1, shared_xaxes=True, row_heights=[0.7, 0.3], vertical_spacing=0.06)
    lines = list(dict.fromkeys((row.mean, row.choice) for row in rows))
    for number, (mean, choice) in enumerate(lines):
        chosen = [row for row in rows if (row.mean, row.choice) == (mean, choice)]
        _draw(figure, chosen, f'{mean} mean, {choice}', RUN_COLOURS[number % len(RUN_COLOURS)])
    across = {'color': INK, 'dash': 'dash', 'width': 1.5}
    figure.add_hline(
        analytical.mean_mm, line=across, annotation_text='analytical controller', row=1, col=1
    )
    styled(figure, HEIGHT)
    figure.update_xaxes(type='log', title='training pushes', row=2, col=1)
    figure.update_xaxes(type='log', row=1, col=1)
    figure.update_yaxes(title='mean tracking error [mm]', rangemode='tozero', row=1, col=1)
    figure.update_yaxes(title='completed laps [%]', range=[-5, 105], row=2, col=1)
    shown = section('8-track at 80 mm/s', deferred(figure, 'sizes'), TEXT)
    return page('Error over training size', [shown])


def _draw(figure: go.Figure, rows: Sequence[SizeRow], name: str, colour: str) -> None:
    style = {'mode': 'lines+markers', 'line': {'color': colour}, 'name': name}
    known = [(row.points, row.quartiles) for row in rows if row.quartiles is not None]
    bars = {
        'symmetric': False,
        'array': [high - middle for _, (_, middle, high) in known],
        'arrayminus': [middle - low for _, (low, middle, _) in known],
    }
    sizes, median = [size for size, _ in known], [middle for _, (_, middle, _) in known]
    figure.add_trace(go.Scatter(x=sizes, y=median, error_y=bars, **style), row=1, col=1)
    share = go.Scatter(
        x=[row.points for row in rows],
        y=[100.0 * row.completed / len(row.laps) for row in rows],
        showlegend=False,
        **style,
    )
    figure.add_trace(share, row=2, col=1)
