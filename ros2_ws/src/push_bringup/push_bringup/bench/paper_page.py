"""`bench table --html`: the rows and drawings of their laps."""

from collections.abc import Sequence
from html import escape

import plotly.graph_objects as go
from plotly.subplots import make_subplots
from push_mpc.settings import CONTROLLERS
from push_report.figure_style import GREY, INK, RUN_COLOURS, styled
from push_report.page import drawn, page, section

from push_bringup.bench.rows import PaperRow
from push_bringup.experiment import LapJob

HEADS = (
    *('track', 'speed', 'perturbation', 'controller', 'profile', 'laps'),
    *('median', 'truth', 'paper'),
)
PANEL_HEIGHT = 380
COLUMNS = tuple(CONTROLLERS)


def paper_page(rows: Sequence[PaperRow]) -> str:
    """The page."""
    profiles = list(dict.fromkeys(row.profile for row in rows))
    figures = [
        section(f'The laps, profile {profile}', _figure([r for r in rows if r.profile == profile]))
        for profile in profiles
    ]
    return page("The paper's table", [section('The rows', _table(rows)), *figures])


def _table(rows: Sequence[PaperRow]) -> str:
    head = ''.join(f'<th>{name}</th>' for name in HEADS)
    return f'<table><tr>{head}</tr>{"".join(map(_row, rows))}</table>'


def _row(row: PaperRow) -> str:
    figures = row.as_json()
    cells = (
        row.experiment.track,
        f'{1e3 * row.experiment.speed:.0f} mm/s',
        row.experiment.perturbation,
        row.controller,
        row.profile,
        f'{row.completed} of {len(row.laps)}',
        f'{figures["median_mm"]:.2f} mm',
        f'{figures["truth_median_mm"]:.2f} mm',
        f'{figures["paper_mm"]:.2f} mm',
    )
    return '<tr>' + ''.join(f'<td>{escape(cell)}</td>' for cell in cells) + '</tr>'


def _figure(rows: Sequence[PaperRow]) -> str:
    """One panel per row: reference, and the path of every seed."""
    experiments = list(dict.fromkeys(row.experiment for row in rows))
    titles = [_panel_title(row) for experiment in experiments for row in _pair(rows, experiment)]
    figure = make_subplots(
        len(experiments), len(COLUMNS), subplot_titles=titles, vertical_spacing=0.05
    )
    for line, experiment in enumerate(experiments, start=1):
        for column, row in enumerate(_pair(rows, experiment), start=1):
            _draw(figure, row, line, column)
    styled(figure, PANEL_HEIGHT * len(experiments), showlegend=False)
    return drawn(figure)


def _pair(rows: Sequence[PaperRow], experiment: object) -> list[PaperRow]:
    by_name = {row.controller: row for row in rows if row.experiment == experiment}
    return [by_name[name] for name in COLUMNS if name in by_name]


def _panel_title(row: PaperRow) -> str:
    kick = '' if row.experiment.perturbation == 'none' else f', {row.experiment.perturbation}'
    return f'{row.experiment.track} {1e3 * row.experiment.speed:.0f} mm/s{kick}, {row.controller}'


def _draw(figure: go.Figure, row: PaperRow, line: int, column: int) -> None:
    x, y = _reference(row)
    dots = {'color': INK, 'width': 1, 'dash': 'dot'}
    figure.add_trace(go.Scatter(x=x, y=y, mode='lines', line=dots), row=line, col=column)
    for seed, lap in enumerate(row.laps):
        colour = RUN_COLOURS[seed % len(RUN_COLOURS)] if lap.completed else GREY
        xs, ys = zip(*lap.path_mm, strict=True) if lap.path_mm else ((), ())
        path = go.Scatter(x=xs, y=ys, mode='lines', name=f'seed {seed}', line={'color': colour})
        figure.add_trace(path, row=line, col=column)
    number = (line - 1) * len(COLUMNS) + column
    figure.update_yaxes(scaleanchor=f'x{number if number > 1 else ""}', row=line, col=column)


def _reference(row: PaperRow) -> tuple[list[float], list[float]]:
    from push_mpc.plan.planning import planned  # noqa: PLC0415

    job = LapJob(row.experiment, 'analytical', 'analytical', row.profile, 0)
    x, y = (planned(job.parameters().mpc).state[::20, :2] * 1e3).round(2).T.tolist()
    return x, y
