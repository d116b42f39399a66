"""Output of `validate`: its JSON object, its table and its HTML page."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from push_core.common import plain_table
from push_core.data import LongPushes, RobotRun, accuracy
from push_core.geometry import Array, wrap_angle
from push_core.physics import ActuatorSettings

from push_sim.measured import (
    COLUMNS,
    rms_coordinate,
    tip_error,
)
from push_sim.validation.comparison import (
    LongComparison,
    RunComparison,
    ShortComparison,
    Validation,
)

_Row: TypeAlias = tuple[str, ...]

PAGE_TEXT = (
    'The simulator, and beside it the ellipsoidal limit surface alone, repeat measured pushes '
    'and runs of the robot from their measured starts. Of more than 1500 short pushes every '
    'k-th is drawn; the numbers are of all.'
)


def validation_json(result: Validation) -> dict[str, Any]:
    """The JSON object; a part without files is null or an empty list."""
    return {
        'pushes_4mm': _short_json(result.short) if result.short else None,
        'pushes_50mm': [_long_json(comparison) for comparison in result.long],
        'robot_runs': [_run_json(comparison) for comparison in result.runs],
        'missing': list(result.missing),
    }


def _short_json(compared: ShortComparison) -> dict[str, Any]:
    simulated, ellipsoid = (
        accuracy(predicted, compared.pushes).as_json()
        for predicted in (compared.simulated, compared.ellipsoid)
    )
    return {**simulated, 'limit_surface': ellipsoid}


def _long_json(compared: LongComparison) -> dict[str, Any]:
    return {
        'file': compared.file,
        **_end_errors(compared.pushes, compared.simulated),
        'limit_surface': _end_errors(compared.pushes, compared.ellipsoid),
    }


def _end_errors(pushes: LongPushes, predicted: Array) -> dict[str, Any]:
    errors = pushes.errors(predicted)
    everywhere = np.ones(len(pushes), dtype=np.bool_)
    return {'on_face': errors.of(pushes.on_face), 'all': errors.of(everywhere)}


def _run_json(compared: RunComparison) -> dict[str, Any]:
    run = compared.run
    return {
        'file': run.name,
        **_tip_errors(run, compared.actuator),
        **_slider_errors(compared, compared.simulated),
        'windows': len(compared.simulated),
        'rows': len(run.time),
        'rows_followed': run.following,
        'identified': _tip_errors(run, compared.identified),
        'limit_surface': _slider_errors(compared, compared.ellipsoid),
    }


def _tip_errors(run: RobotRun, actuator: ActuatorSettings) -> dict[str, float]:
    rms = rms_coordinate(tip_error(run, actuator))
    return {
        'lag_s': actuator.lag,
        'dead_time_s': actuator.dead_time,
        'tip_rms_mm': rms * 1e3,
        'tip_distance_rms_mm': rms * np.sqrt(2.0) * 1e3,
    }


def _slider_errors(compared: RunComparison, predicted: Array) -> dict[str, float]:
    error = predicted - compared.windows.end
    distance, angle = (
        np.linalg.norm(error[:, :2]),
        np.linalg.norm([wrap_angle(turn) for turn in error[:, 2].tolist()]),
    )
    root_of_count = np.sqrt(len(error))
    return {
        'slider_rms_mm': float(distance / root_of_count) * 1e3,
        'slider_rms_deg': float(np.degrees(angle / root_of_count)),
    }


def validation_table(figures: Mapping[str, Any], profile: str) -> str:
    """The figures of `validation_json` as text.

    Args:
        figures: all of them.
        profile: name of the plant's profile.
    """
    missing = (
        f'no {kind}: no file has the columns {", ".join(COLUMNS[kind])}'
        for kind in figures['missing']
    )
    return '\n'.join([*plain_table(validation_rows(figures, profile)), *missing, ''])


def validation_rows(figures: Mapping[str, Any], profile: str) -> list[tuple[str, ...]]:
    """The cells of `validation_table`, its head first."""
    return [
        (f'profile {profile}', 'simulator', 'ellipsoid', 'reference'),
        *_short_rows(figures['pushes_4mm']),
        *(row for each in figures['pushes_50mm'] for row in _long_rows(each)),
        *(row for each in figures['robot_runs'] for row in _run_rows(each)),
    ]


def _row(title: str, first: float | None, second: float | None, reference: str = '') -> _Row:
    numbers = ('' if value is None else f'{value:.3f}' for value in (first, second))
    return (f'  {title}', *numbers, reference)


def _short_rows(figures: Mapping[str, Any] | None) -> Iterator[_Row]:
    if figures is None:
        return
    other = figures['limit_surface']
    yield f'{figures["n"]} pushes of 4 mm', '', '', ''
    for name, label in (('dx_mm', 'x [mm]'), ('dy_mm', 'y [mm]'), ('dtheta_deg', 'theta [deg]')):
        yield _row(f'RMSE {label}', figures['rmse'][name], other['rmse'][name])
    for frame, remark in (('push', 'GP of 1000 points 0.037; at most 0.070'), ('body', '')):
        ours, theirs = (each[f'nmse_{frame}_frame'] for each in (figures, other))
        for name in ('dx', 'dy', 'dtheta'):
            yield _row(f'NMSE {name}, {frame} frame', ours[name], theirs[name])
        yield _row(f'NMSE mean, {frame} frame', ours['mean'], theirs['mean'], remark)


def _long_rows(figures: Mapping[str, Any]) -> Iterator[_Row]:
    yield f'{figures["file"]}: mean error at the end', '', '', ''
    for part, title, limits in (
        ('on_face', '{} pushes on the face', ('at most 3.8', 'at most 4.3')),
        ('all', 'all {} pushes', ('', '')),
    ):
        ours, theirs = figures[part], figures['limit_surface'][part]
        name = title.format(ours['n'])
        yield _row(f'{name} [mm]', ours['mean_mm'], theirs['mean_mm'], limits[0])
        yield _row(f'{name} [deg]', ours['mean_deg'], theirs['mean_deg'], limits[1])


def _run_rows(figures: Mapping[str, Any]) -> Iterator[_Row]:
    best, other = figures['identified'], figures['limit_surface']
    yield figures['file'], '', '', ''
    yield _row('tip, rms of a coordinate [mm]', figures['tip_rms_mm'], None, _times(figures))
    yield _row('the same, fitted to this run [mm]', best['tip_rms_mm'], None, _times(best))
    ours, theirs = figures['slider_rms_mm'], other['slider_rms_mm']
    yield _row('object, rms after 0.5 s [mm]', ours, theirs, f'{figures["windows"]} windows')
    yield _row('object, rms after 0.5 s [deg]', figures['slider_rms_deg'], other['slider_rms_deg'])


def _times(figures: Mapping[str, Any]) -> str:
    dead_time, lag = figures['dead_time_s'], figures['lag_s']
    return f'dead time {dead_time * 1e3:.1f} ms, lag {lag * 1e3:.1f} ms'


def write_validation_page(path: Path, result: Validation, profile: str, table: str) -> None:
    """Writes the HTML page: the table, then figures of pushes and runs.

    Args:
        path: HTML file; written completely or not at all.
        result: comparisons to show.
        profile: name of the plant's profile.
        table: text of `validation_table`.

    Raises:
        InputError: the file cannot be written.
    """
    # plotly takes a second to import
    from push_report.page import write_page  # noqa: PLC0415

    from push_sim.validation.push_figures import long_figures, short_figures  # noqa: PLC0415
    from push_sim.validation.run_figure import run_figures  # noqa: PLC0415

    parts = [
        *([short_figures(result.short)] if result.short else []),
        *(long_figures(each) for each in result.long),
        *(run_figures(each) for each in result.runs),
    ]
    title = f'Plant and measurements, profile {profile}'
    write_page(path, title, table.splitlines(), parts, PAGE_TEXT)
