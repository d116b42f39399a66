"""`bench table --html`: the rows, their errors beside the paper's, and their laps."""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from push_mpc.settings import CONTROLLERS
from push_report.deferred_figure import deferred
from push_report.figure_style import (
    GREY,
    INK,
    LOW_TO_HIGH,
    MOST_MARKERS,
    ROBUST_END,
    RUN_COLOURS,
    robust_limit,
    styled,
    thinned,
)
from push_report.page import page, panels, section, table

from push_bringup.bench.rows import PaperRow
from push_bringup.experiment import Lap, LapJob

HEADS = (
    *('track', 'speed', 'perturbation', 'controller', 'profile', 'laps'),
    *('median', 'truth', 'paper'),
)
ROW_HEIGHT, LAP_HEIGHT, CURVE_HEIGHT = 42, 560, 300
COLOURS = dict(zip(CONTROLLERS, RUN_COLOURS, strict=False))
LEAST_COLOUR_RANGE = 0.5  # [mm]
ERRORS_TEXT = (
    'Mean tracking error of each lap: a dot is one seed, the box reaches from the lower to the '
    'upper quartile with the median as a line, the diamond is the figure of the paper, where it '
    'has one. The axis is logarithmic; laps that were not completed are grey crosses.'
)
LAP_TEXT = (
    f'One lap of the first seed, with its tracking error as colour up to {ROBUST_END}; larger '
    'errors, as after a perturbation, have the last colour.'
)
CURVES_TEXT = (
    'Tracking error over the lap, from its start to its end: a thin line is one seed, the thick '
    f'one the median over the seeds. Axes end at {ROBUST_END}; a double click shows all.'
)


def paper_page(rows: Sequence[PaperRow]) -> str:
    """The page."""
    sections = [section('The rows', table(HEADS, [_cells(row) for row in rows]))]
    for profile in dict.fromkeys(row.profile for row in rows):
        own = [row for row in rows if row.profile == profile]
        errors = deferred(_errors(own), f'errors-{profile}')
        lap = deferred(_lap(own[0]), f'lap-{profile}')
        curves = [
            _curves([row for row in own if row.experiment == experiment])
            for experiment in dict.fromkeys(row.experiment for row in own)
        ]
        sections += [
            section(f'Errors, profile {profile}', errors, ERRORS_TEXT),
            section(f'One lap: {_name(own[0])}', lap, LAP_TEXT),
            section('Error over the lap', panels(curves, f'curves-{profile}'), CURVES_TEXT),
        ]
    return page("The paper's table", sections)


def _cells(row: PaperRow) -> list[str]:
    figures = row.as_json()
    paper = figures['paper_mm']
    return [
        row.experiment.track,
        f'{1e3 * row.experiment.speed:.0f} mm/s',
        row.experiment.perturbation,
        row.controller,
        row.profile,
        f'{row.completed} of {len(row.laps)}',
        f'{figures["median_mm"]:.2f} mm',
        f'{figures["truth_median_mm"]:.2f} mm',
        '–' if paper is None else f'{paper:.2f} mm',
    ]


def _name(row: PaperRow) -> str:
    return f'{_experiment(row)}, {row.controller}'


def _label(row: PaperRow) -> str:
    """The name in two lines, narrow enough for a phone."""
    return f'{_experiment(row)}<br>{row.controller}'


def _experiment(row: PaperRow) -> str:
    kick = '' if row.experiment.perturbation == 'none' else f', {row.experiment.perturbation} kick'
    return f'{row.experiment.track} {1e3 * row.experiment.speed:.0f} mm/s{kick}'


def _errors(rows: Sequence[PaperRow]) -> go.Figure:
    """A line for each row: its laps as dots, their quartiles as a box, the paper's figure."""
    figure = go.Figure()
    labels = [_label(row) for row in rows]
    for name, colour in COLOURS.items():
        own = [row for row in rows if row.controller == name]
        if own:
            _add_boxes(figure, own, name, colour)
    papers = [row.as_json()['paper_mm'] for row in rows]
    diamond = {'symbol': 'diamond', 'size': 11, 'color': 'white'}
    diamond |= {'line': {'color': INK, 'width': 2}}
    figure.add_scatter(x=papers, y=labels, mode='markers', name='paper', marker=diamond)
    styled(figure, 130 + ROW_HEIGHT * len(rows), barmode='overlay', hovermode='closest')
    figure.update_layout(margin={'l': 20})
    figure.update_xaxes(type='log', title='mean error [mm]', dtick='D2')
    order = {'categoryorder': 'array', 'categoryarray': labels[::-1]}
    return figure.update_yaxes(automargin=True, **order)


def _add_boxes(figure: go.Figure, rows: Sequence[PaperRow], name: str, colour: str) -> None:
    for row in rows:
        errors = [lap.mean_mm for lap in row.laps if lap.completed]
        if errors:
            _add_box(figure, _label(row), np.array(errors), colour)
    for is_done, mark in ((True, {'color': colour}), (False, {'color': GREY, 'symbol': 'x'})):
        laps = [(lap.mean_mm, _label(row)) for row in rows for lap in row.laps]
        done = [lap.completed for row in rows for lap in row.laps]
        chosen = [each for each, ended in zip(laps, done, strict=True) if ended is is_done]
        if chosen:
            x, y = zip(*chosen, strict=True)
            label = name if is_done else f'{name}, not completed'
            figure.add_scatter(x=x, y=y, mode='markers', name=label, marker=mark | {'size': 6})


def _add_box(figure: go.Figure, label: str, errors: np.ndarray, colour: str) -> None:
    """A box from the lower to the upper quartile of errors (n,) [mm], with the median."""
    low, middle, high = np.percentile(errors, [25.0, 50.0, 75.0]).tolist()
    figure.add_bar(
        orientation='h',
        x=[high - low],
        base=[low],
        y=[label],
        width=0.55,
        marker={'color': colour, 'opacity': 0.3, 'line': {'color': colour, 'width': 1.5}},
        hovertemplate=f'quartiles {low:.2f} to {high:.2f} mm<extra></extra>',
        showlegend=False,
    )
    figure.add_scatter(
        x=[middle],
        y=[label],
        mode='markers',
        marker={'symbol': 'line-ns-open', 'size': 18, 'color': colour, 'line': {'width': 3}},
        hovertemplate=f'median {middle:.2f} mm<extra></extra>',
        showlegend=False,
    )


def _lap(row: PaperRow) -> go.Figure:
    """The first lap, coloured by its error, over the reference."""
    lap = row.laps[0]
    figure = go.Figure()
    planned_x, planned_y = _reference(row)
    dots = {'color': INK, 'width': 1.5, 'dash': 'dot'}
    figure.add_scatter(x=planned_x, y=planned_y, mode='lines', name='reference', line=dots)
    path, error = np.reshape(lap.path_mm, (-1, 2)), np.array(lap.error_mm)
    x, y, error = thinned(path[:, 0], path[:, 1], error, most=MOST_MARKERS)
    bar = {'title': {'text': 'tracking error [mm]', 'side': 'right'}, 'len': 0.8}
    marker = {'size': 6, 'color': error, 'colorscale': LOW_TO_HIGH, 'colorbar': bar, 'cmin': 0.0}
    marker['cmax'] = robust_limit(error, LEAST_COLOUR_RANGE)
    figure.add_scatter(
        x=x,
        y=y,
        mode='markers',
        name='path of the object',
        marker=marker,
        customdata=error[:, None],
        hovertemplate='error %{customdata[0]:.2f} mm<extra></extra>',
    )
    styled(figure, LAP_HEIGHT, hovermode='closest')
    figure.update_xaxes(title='x [mm]')
    return figure.update_yaxes(title='y [mm]', scaleanchor='x', scaleratio=1.0)


def _curves(rows: Sequence[PaperRow]) -> go.Figure:
    """Errors over the lap of one experiment with each controller."""
    figure, shown = go.Figure(), [np.zeros(0)]
    for row in rows:
        colour = COLOURS[row.controller]
        curves = [_curve(lap) for lap in row.laps if lap.error_mm]
        for curve in curves:
            line = {'color': colour, 'width': 0.7}
            figure.add_scatter(
                x=SHARES, y=curve, mode='lines', line=line, opacity=0.5, showlegend=False
            )
        if curves:
            middle = np.median(curves, axis=0)
            line = {'color': colour, 'width': 2}
            figure.add_scatter(x=SHARES, y=middle, mode='lines', line=line, name=row.controller)
            shown += curves
    styled(figure, CURVE_HEIGHT, margin={'l': 50, 'r': 10, 't': 70, 'b': 45})
    figure.update_layout(title={'text': _experiment(rows[0]), 'font': {'size': 14}, 'y': 0.97})
    figure.update_xaxes(title='share of the lap [%]', dtick=25, ticklabeloverflow='allow')
    highest = 1.1 * robust_limit(np.concatenate(shown), LEAST_COLOUR_RANGE)
    return figure.update_yaxes(title='error [mm]', range=[0.0, highest])


SHARES = np.linspace(0.0, 100.0, 201).astype(np.float32)


def _curve(lap: Lap) -> np.ndarray:
    """Errors (n,) [mm] at SHARES of the part of the lap that was pushed."""
    own = np.linspace(0.0, 100.0, len(lap.error_mm))
    return np.interp(SHARES, own, lap.error_mm).astype(np.float32)


def _reference(row: PaperRow) -> tuple[list[float], list[float]]:
    from push_mpc.plan.planning import planned  # noqa: PLC0415

    job = LapJob(row.experiment, 'analytical', 'analytical', row.profile, 0)
    x, y = (planned(job.parameters().mpc).state[::20, :2] * 1e3).round(2).T.tolist()
    return x, y
