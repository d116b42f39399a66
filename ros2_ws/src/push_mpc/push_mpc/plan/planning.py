"""Plans along the track that the parameters of the node name."""

import math

import numpy as np
from push_core import tracks
from push_core.common import InputError
from push_core.geometry import Array
from push_core.physics import SafetyLimits

from push_mpc.plan.nominal import Plan, TooTightError, flat_plan
from push_mpc.plan.task import PlanningTask
from push_mpc.settings import MpcSettings

_PLACES = 1000
_FARTHEST_OF_METRES = 20.0
_MARGIN = 0.5  # [s] beyond horizon and delay


def planned(settings: MpcSettings) -> Plan:
    """Plans along the track that the settings name.

    Raises:
        InputError: an unknown track, one that cannot be pushed or leaves the workspace, or too
            high a speed.
    """
    fastest = min(settings.limits.speed, settings.actuator.speed_limit)
    if settings.speed > fastest:
        raise InputError(
            f'parameter speed is {settings.speed:g}, must be between 0.001 and {fastest:g} m/s, '
            'the limit of the pusher'
        )
    track = tracks.by_name(settings.track)
    _check_workspace(track, settings)
    if settings.laps > 1 and not track.closed:
        raise InputError(
            f'track {track.name} is open and has no second lap; its end is '
            f'{1e3 * _gap(track):.4g} mm from its start'
        )
    plan = _plan(settings, track)
    check_pushes(plan, settings)
    return plan


def _plan(settings: MpcSettings, track: tracks.Track) -> Plan:
    task = _task(settings, track)
    if settings.planner == 'optimal' or task.headings != (None, None):
        return _optimal(task)
    try:
        return flat_plan(
            track, settings.speed, settings.slider, settings.laps, settings.period, task.overrun
        )
    except TooTightError:
        if settings.planner == 'flat':
            raise
        return _optimal(task)


def _optimal(task: PlanningTask) -> Plan:
    # casadi takes 0.1 s to import, and few runs need it
    from push_mpc.plan.optimal_plan import optimal_plan  # noqa: PLC0415

    return optimal_plan(task)


def check_pushes(plan: Plan, settings: MpcSettings) -> None:
    """Checks the planned pusher motion against the limits.

    Raises:
        InputError: names the limit that the plan exceeds, and where.
    """
    tracked = plan.time <= plan.duration
    v_n, v_t = np.abs(plan.input[tracked].T)
    p_y = np.abs(plan.state[tracked, 3])
    fastest = min(settings.limits.speed, settings.actuator.speed_limit)
    checks = (
        (np.hypot(v_n, v_t), fastest, 'a pusher speed of {:.3f} m/s'),
        (v_n, settings.normal_speed_limit, 'v_n = {:.3f} m/s'),
        (v_t, settings.tangential_speed_limit, '|v_t| = {:.3f} m/s'),
        (p_y, 0.5 * settings.slider.side, '|p_y| = {:.3f} m'),
    )
    for values, limit, what in checks:
        worst = int(np.argmax(values))
        if values[worst] > limit:
            raise InputError(
                f'track {settings.track} at {settings.speed:g} m/s needs '
                f'{what.format(values[worst])} near {1e3 * settings.speed * plan.time[worst]:.0f} '
                f'mm along it; the limit is {limit:g}, so take a lower speed or a wider track'
            )


def _task(settings: MpcSettings, track: tracks.Track) -> PlanningTask:
    delay = settings.actuator.dead_time + settings.actuator.lag
    return PlanningTask(
        track=track,
        speed=settings.speed,
        slider=settings.slider,
        duration=settings.laps * track.length / settings.speed,
        overrun=settings.horizon_length / settings.speed + delay + _MARGIN,
        period=settings.period,
        speed_limits=(settings.normal_speed_limit, settings.tangential_speed_limit),
        headings=(
            _heading('start_heading', settings.start_heading),
            _heading('end_heading', settings.end_heading),
        ),
    )


def _heading(name: str, text: str) -> float | None:
    """A heading [rad] from a text in degrees, None for `free`."""
    if text == 'free':
        return None
    try:
        degrees = float(text)
    except ValueError:
        degrees = math.nan
    if not math.isfinite(degrees):
        raise InputError(f'parameter {name} is {text!r}, must be a number of degrees or free')
    return math.radians(degrees)


def _unit_hint(farthest: float) -> str:
    """What a file with a point that far [m] from the origin may be."""
    if farthest > _FARTHEST_OF_METRES:
        return 'its points are in metres, but look like millimetres: divide them by 1000'
    return 'its points are in metres'


def _gap(track: tracks.Track) -> float:
    """Distance [m] of the ends of a track."""
    x, y, _, _ = track.at(np.array([0.0, track.length]))
    return math.hypot(x[1] - x[0], y[1] - y[0])


def _check_workspace(track: tracks.Track, settings: MpcSettings) -> None:
    """Checks the track's extent; a file in millimetres would make a plan of hours."""
    limits = settings.limits
    x, y, _, _ = track.at(np.linspace(0.0, track.length, _PLACES, endpoint=False))
    if settings.start_from == 'here':
        _check_extent(track, np.hypot(x - x[0], y - y[0]), limits)
    elif np.abs(x).max() > limits.workspace_x or np.abs(y).max() > limits.workspace_y:
        raise InputError(
            f'track {track.name} leaves the workspace of +-{limits.workspace_x:g} m by '
            f'+-{limits.workspace_y:g} m; {_unit_hint(max(np.abs(x).max(), np.abs(y).max()))}'
        )


def _check_extent(track: tracks.Track, away: Array, limits: SafetyLimits) -> None:
    """Checks that a track that will be moved can fit; `away` (n,) [m] is from its start."""
    diagonal = 2.0 * math.hypot(limits.workspace_x, limits.workspace_y)
    if away.max() > diagonal:
        raise InputError(
            f'track {track.name} goes {away.max():.3g} m away from its start, more than the '
            f'diagonal of the workspace of {diagonal:.3g} m; {_unit_hint(away.max())}'
        )
