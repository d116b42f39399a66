"""A validation as a table: the simulator, the ellipsoid, and figures to compare with."""

from collections.abc import Iterator, Mapping
from typing import Any

from push_sim.measured import LONG_FILES, RUN_FILES, SHORT_FILES

_NAMES = {
    SHORT_FILES: 'short pushes',
    LONG_FILES: 'long pushes',
    RUN_FILES: 'robot runs',
}


def validation_table(figures: Mapping[str, Any], profile: str) -> str:
    """The figures of `validation_json` as text.

    Args:
        figures: all of them.
        profile: name of the plant's.
    """
    lines = [
        _heading(f'profile {profile}', 'simulator', 'ellipsoid'),
        *_short(figures['pushes_4mm']),
        *(line for each in figures['pushes_50mm'] for line in _long(each)),
        *(line for each in figures['robot_runs'] for line in _run(each)),
        *(f'no {_NAMES[each]}: there is no {each}' for each in figures['missing']),
    ]
    return '\n'.join(lines) + '\n'


def _heading(title: str, first: str, second: str) -> str:
    return f'{title:44}{first:>11}{second:>11}  for comparison'


def _row(title: str, first: float | None, second: float | None, remark: str = '') -> str:
    return f'  {title:42}{_number(first)}{_number(second)}  {remark}'.rstrip()


def _number(value: float | None) -> str:
    return f'{"":11}' if value is None else f'{value:11.3f}'


def _short(figures: Mapping[str, Any] | None) -> Iterator[str]:
    if figures is None:
        return
    other = figures['limit_surface']
    yield f'{figures["n"]} pushes of 4 mm, each on its own'
    for name, label in (('dx_mm', 'x [mm]'), ('dy_mm', 'y [mm]'), ('dtheta_deg', 'theta [deg]')):
        yield _row(f'RMSE {label}', figures['rmse'][name], other['rmse'][name])
    for frame, remark in (('push', 'GP of 1000 points 0.037; at most 0.070'), ('body', '')):
        ours, theirs = (each[f'nmse_{frame}_frame'] for each in (figures, other))
        for name in ('dx', 'dy', 'dtheta'):
            yield _row(f'NMSE {name}, {frame} frame', ours[name], theirs[name])
        yield _row(f'NMSE mean, {frame} frame', ours['mean'], theirs['mean'], remark)


def _long(figures: Mapping[str, Any]) -> Iterator[str]:
    yield f'{figures["file"]}: mean error at the end'
    for part, name, goal in (
        ('on_face', 'on the face', ('at most 3.8', 'at most 4.3')),
        ('all', 'all', ('', '')),
    ):
        ours, theirs = figures[part], figures['limit_surface'][part]
        title = f'{ours["n"]} pushes {name}' if part == 'on_face' else f'all {ours["n"]} pushes'
        yield _row(f'{title} [mm]', ours['mean_mm'], theirs['mean_mm'], goal[0])
        yield _row(f'{title} [deg]', ours['mean_deg'], theirs['mean_deg'], goal[1])


def _run(figures: Mapping[str, Any]) -> Iterator[str]:
    best, other = figures['identified'], figures['limit_surface']
    yield f'{figures["file"]}'
    yield _row('tip, rms a coordinate [mm]', figures['tip_rms_mm'], None, _times(figures))
    yield _row('the same with its own fit [mm]', best['tip_rms_mm'], None, _times(best))
    ours, theirs = figures['slider_rms_mm'], other['slider_rms_mm']
    yield _row('object, rms after 0.5 s [mm]', ours, theirs, f'{figures["windows"]} windows')
    yield _row('object, rms after 0.5 s [deg]', figures['slider_rms_deg'], other['slider_rms_deg'])


def _times(figures: Mapping[str, Any]) -> str:
    dead_time, lag = figures['dead_time_s'], figures['lag_s']
    return f'dead time {dead_time * 1e3:.1f} ms, lag {lag * 1e3:.1f} ms'
