"""Whether a cell did what a fault must lead to."""

import math

import numpy as np
from push_core.geometry import Array
from push_core.physics import ActuatorSettings, SafetyLimits
from push_mpc.loop import FOLLOWING, Mode

from push_bringup.faults.case import Case, Outcome
from push_bringup.faults.observer import Seen

AT_REST = 0.005  # [m/s]; with the lag of the robot less than 0.3 mm of path are left
REST_TIME = 0.25  # [s] from a fault that can be known to the tip at rest, braking and lag included
HOST_GAP = 0.1  # [s] in which this process did not run: the host took the cores away
FAR = 0.005  # [m] from the reference, on average over the last half second of a run that goes on
_LAST = 0.5  # [s]
_WORKSPACE = 0.6  # [m]


def speeds(tips: Array) -> tuple[Array, Array]:
    """Stamps (n,) [ns] and speeds (n,) [m/s] of the tip between positions (n + 1, 3)."""
    steps = np.diff(tips, axis=0)
    moved = steps[:, 0] > 0.0
    speed = np.hypot(*steps[moved, 1:].T) / (1e-9 * steps[moved, 0])
    return tips[1:, 0][moved], speed


def rest_time(seen: Seen, begun: int) -> float:
    """Time [s] from a stamp [ns] until the tip is at rest for good; NaN if it moves at the end."""
    if len(seen.tips) < 2:
        return 0.0
    stamps, speed = speeds(np.array(seen.tips))
    moving = stamps[speed > AT_REST]
    if moving.size and moving[-1] == stamps[-1] and stamps[-1] > begun:
        # a plant that was killed or halted in motion is at rest with its last picture
        return math.nan
    return max(1e-9 * float(moving[-1] - begun), 0.0) if moving.size else 0.0


def fastest(seen: Seen) -> float:
    """Largest speed of the tip [m/s]."""
    return float(speeds(np.array(seen.tips))[1].max(initial=0.0)) if len(seen.tips) > 1 else 0.0


def problems(case: Case, seen: Seen, begun: int, lasts: float, reason: str) -> list[str]:
    """What was not as it must be.

    Args:
        case: that was run.
        seen: of it.
        begun: stamp at which the fault began [ns].
        lasts: time [s] that it lasted.
        reason: that the controller or the cell gave.
    """
    fault = case.fault
    found = _limit_problems(seen)
    if fault.outcome in (Outcome.STOPS, Outcome.RESTS):
        rest = rest_time(seen, begun)
        if not rest <= fault.detection + REST_TIME:
            found.append(f'at rest after {rest:.3f} s, not {fault.detection + REST_TIME:.3f} s')
    if fault.outcome == Outcome.STOPS and not _modes(seen) & {Mode.STOPPED, Mode.FAULT}:
        found.append('it did not stop')
    if fault.outcome == Outcome.CONTINUES:
        found += _progress_problems(seen, begun + round(1e9 * lasts))
    if fault.outcome == Outcome.REFUSES and _modes(seen) & {Mode.TRACKING, Mode.RECONTACT}:
        found.append('it started')
    if fault.reason not in reason:
        found.append(f'the reason is {reason!r}, without {fault.reason!r}')
    return found


def _modes(seen: Seen) -> set[int]:
    return {state[1] for state in seen.states}


def _limit_problems(seen: Seen) -> list[str]:
    """Limits that a command or the tip did not keep."""
    limits, actuator, found = SafetyLimits(), ActuatorSettings(), []
    commands = np.array(seen.commands).reshape(-1, 3)
    if not np.isfinite(commands).all():
        found.append('a command is not finite')
    if np.hypot(*commands[:, 1:].T).max(initial=0.0) > limits.speed * (1.0 + 1e-9):
        found.append('a command is too fast')
    if fastest(seen) > actuator.speed_limit * (1.0 + 1e-3):
        found.append(f'the tip moves with {fastest(seen):.3f} m/s')
    places = np.abs(np.array(seen.tips).reshape(-1, 3)[:, 1:])
    if places.max(initial=0.0) > _WORKSPACE:
        found.append('the tip leaves the workspace')
    return found


def _progress_problems(seen: Seen, healed: int) -> list[str]:
    """Why a run did not go on after a stamp [ns]."""
    stopped = _modes(seen) & {Mode.STOPPED, Mode.FAULT}
    if stopped:
        return ['it stopped']
    after = [state for state in seen.states if state[0] > healed]
    last = [state for state in after if state[0] > after[-1][0] - 1e9 * _LAST]
    # a host that is busy makes single holds
    tracking = [state[3] for state in last if state[1] in (*FOLLOWING, Mode.DONE)]
    if not last or len(tracking) < 0.5 * len(last):
        modes = ', '.join(sorted({Mode(state[1]).name for state in last}))
        return [f'it does not track at the end: {modes or "no tick"}']
    distance = float(np.nanmean(tracking))
    return [f'{1e3 * distance:.1f} mm from the reference'] if distance > FAR else []
