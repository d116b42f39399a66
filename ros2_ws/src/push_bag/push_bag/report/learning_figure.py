"""From lap to lap: the errors, what was identified, and how the reference was shifted."""

from collections.abc import Sequence

import numpy as np
import plotly.graph_objects as go
from push_core.geometry import rotation
from push_report.figure_style import INK, RUN_COLOURS, styled, thinned

from push_bag.report.reported_run import ReportedRun
from push_bag.run import DrivenLesson, Floats, Reference

HEIGHT = 300
SHIFT_HEIGHT = 560
MAGNIFIED = 20
TEXT = (
    'Error: mean over each lap; of the true poses where they were recorded. Friction and support '
    'radius: what drove each lap, with two standard deviations, once something was identified. '
    f'Shift: of the reference against errors that recur, drawn {MAGNIFIED} times as large.'
)


def lap_figures(runs: Sequence[ReportedRun]) -> list[go.Figure]:
    """Error, friction and support radius over the laps; empty where no run has several laps."""
    if all(len(run.score['per_lap']) < 2 for run in runs):
        return []
    figures = [_figure('mean error [mm]')]
    for run in runs:
        _add_errors(figures[0], run)
    if any(lap['identified'] for run in runs for lap in run.score['per_lap']):
        for name, title in (('friction', 'friction'), ('support_radius', 'support radius [mm]')):
            figures.append(_figure(title))
            for run in runs:
                _add_identified(figures[-1], run, name)
    return figures


def shift_figure(run: ReportedRun) -> go.Figure | None:
    """The shifts of the reference over the track; None where it was not shifted."""
    shifted = [each for each in run.series.lessons if each.shift.any()]
    if not shifted:
        return None
    figure = go.Figure()
    places = run.reference.pose[: len(shifted[0].shift), :2]
    figure.add_trace(_line('reference', places, {'color': INK, 'width': 1.5, 'dash': 'dot'}))
    for number, lesson in enumerate(shifted):
        largest = 1e3 * float(np.hypot(*lesson.shift.T).max())
        name = f'shift {number + 1}, {largest:.2f} mm at most'
        colour = RUN_COLOURS[number % len(RUN_COLOURS)]
        moved = places + MAGNIFIED * _in_world(lesson, run.reference)[: len(places)]
        figure.add_trace(_line(name, moved, {'color': colour, 'width': 1.5}))
    styled(figure, SHIFT_HEIGHT, hovermode='closest')
    figure.update_xaxes(title='x [mm]')
    figure.update_yaxes(title='y [mm]', scaleanchor='x', scaleratio=1.0)
    return figure


def _in_world(lesson: DrivenLesson, reference: Reference) -> Floats:
    """The shift (n, 2) [m] in the world frame."""
    return np.asarray(lesson.shift @ rotation(float(reference.pose[0, 2])).T)


def _line(name: str, points: Floats, style: dict[str, object]) -> go.Scatter:
    x, y = thinned(*(1e3 * points.T))
    return go.Scatter(x=x, y=y, mode='lines', name=name, line=style)


def _figure(title: str) -> go.Figure:
    margin = {'l': 70, 'r': 20, 't': 24, 'b': 50}  # without a legend
    figure = styled(go.Figure(), HEIGHT, showlegend=False, margin=margin)
    figure.update_xaxes(title='lap', dtick=1)
    return figure.update_yaxes(title=title, rangemode='tozero')


def _add_errors(figure: go.Figure, run: ReportedRun) -> None:
    laps = run.score['per_lap']
    key = 'mean_mm' if run.score['truth'] is None else 'truth_mean_mm'
    numbers = [*range(1, len(laps) + 1)]
    figure.add_trace(
        go.Scatter(
            x=numbers,
            y=[lap[key] for lap in laps],
            text=[_number(lap[key]) for lap in laps],
            mode='lines+markers+text',
            textposition='top center',
            cliponaxis=False,
            name=run.name,
            line={'color': run.colour, 'width': 1.5},
        )
    )


def _add_identified(figure: go.Figure, run: ReportedRun, name: str) -> None:
    laps = [
        (number, lap['identified'])
        for number, lap in enumerate(run.score['per_lap'], start=1)
        if lap['identified']
    ]
    unit = '_mm' if name == 'support_radius' else ''
    figure.add_trace(
        go.Scatter(
            x=[number for number, _ in laps],
            y=[known[f'{name}{unit}'] for _, known in laps],
            error_y={'array': [2.0 * known[f'{name}_std{unit}'] for _, known in laps]},
            mode='lines+markers',
            name=run.name,
            line={'color': run.colour, 'width': 1.5},
        )
    )


def _number(value: float | None) -> str:
    return '' if value is None else f'{value:.2f}'
