"""`bench data --html`: error and share of completed laps over the training size."""

from collections.abc import Sequence

import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_report.figure_style import INK, RUN_COLOURS, styled
from push_report.page import drawn, page, section

from push_bringup.bench.rows import SizeRow
from push_bringup.experiment import Lap

HEIGHT = 760


def data_page(points: Sequence[SizeRow], analytical: Lap) -> str:
    """The page; the analytical controller's error is a line across."""
    figure = make_subplots(2, 1, shared_xaxes=True, row_heights=[0.7, 0.3], vertical_spacing=0.06)
    lines = list(dict.fromkeys((point.mean, point.choice) for point in points))
    for number, (mean, choice) in enumerate(lines):
        chosen = [point for point in points if (point.mean, point.choice) == (mean, choice)]
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
    return page('Error over training size', [section('8-track at 80 mm/s', drawn(figure))])


def _draw(figure: go.Figure, points: Sequence[SizeRow], name: str, colour: str) -> None:
    style = {'mode': 'lines+markers', 'line': {'color': colour}, 'name': name}
    known = [(point.points, point.quartiles) for point in points if point.quartiles is not None]
    bars = {
        'symmetric': False,
        'array': [high - middle for _, (_, middle, high) in known],
        'arrayminus': [middle - low for _, (low, middle, _) in known],
    }
    sizes, median = [size for size, _ in known], [middle for _, (_, middle, _) in known]
    figure.add_trace(go.Scatter(x=sizes, y=median, error_y=bars, **style), row=1, col=1)
    share = go.Scatter(
        x=[point.points for point in points],
        y=[100.0 * point.completed / len(point.laps) for point in points],
        showlegend=False,
        **style,
    )
    figure.add_trace(share, row=2, col=1)
