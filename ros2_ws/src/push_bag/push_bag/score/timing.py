"""Times of the control loop.

pose to command = publish time of a command - publish time of the pose with the same stamp;
a deadline miss is a pose during tracking whose command came more than DEADLINE later, or never.
A pause: ticks in a row during which the reference did not advance with time, because the
controller had no poses or did not run; see `push_mpc.loop.reference_clock`.
A run in one process or from a file has no middleware and so no time from pose to command.
"""

from dataclasses import dataclass

import numpy as np
from push_msgs.msg import ControllerState

from push_bag.run import Floats, RunSeries
from push_bag.score.tracking import during_tracking

DEADLINE = 0.010  # [s]
WAITING = 1e-3  # [s] between two ticks by which the reference lags; less is rounding of stamps
WITHOUT_MIDDLEWARE = ('inprocess', 'robot')  # the fact `mode` of such runs


@dataclass(frozen=True)
class LoopTiming:
    """Times of the ticks in TRACKING [ms].

    Attributes:
        solve: (n,) of the QP.
        tick: (n,) pose received to command published, by the controller's clock.
        pose_to_command: (m,) over the middleware, of poses with a command; empty for a run in one
            process.
        deadline_misses: number of poses whose command came too late or never.
    """

    solve: Floats
    tick: Floats
    pose_to_command: Floats
    deadline_misses: int


def timing(run: RunSeries) -> LoopTiming:
    """The times of a run during tracking."""
    ticks = run.state('mode') == ControllerState.TRACKING
    latency, without_command = _answers(run)
    late = int(np.count_nonzero(latency > DEADLINE * 1e3))
    solve, tick = (_measured(run.state(name)[ticks]) for name in ('solve_ms', 'tick_ms'))
    return LoopTiming(solve, tick, latency, late + without_command)


def pauses(run: RunSeries) -> dict[str, float] | None:
    """How often the reference waited for the object, and for how long [s]; None without ticks."""
    if not run.states.stamp.size:
        return None
    ticks = run.following & np.isfinite(run.state('reference_time'))
    passed = 1e-9 * np.diff(run.states.stamp[ticks])
    waited = passed - np.diff(run.state('reference_time')[ticks])
    waits = np.concatenate([[False], waited > WAITING, [False]])
    edges = np.flatnonzero(np.diff(waits.astype(np.int8)))
    each = [float(waited[first:end].sum()) for first, end in edges.reshape(-1, 2)]
    return {'count': len(each), 'total_s': sum(each), 'longest_s': max(each, default=0.0)}


def _measured(times: Floats) -> Floats:
    """The finite times; imported runs of the real cell have NaN."""
    return times[np.isfinite(times)]


def _answers(run: RunSeries) -> tuple[Floats, int]:
    """Latency (m,) [ms] of each pose with a command, and the number of poses without one."""
    tracked = during_tracking(run, run.object.stamp)
    index, answered = run.commands.at(run.object.stamp[tracked])
    sent = run.object.published[tracked][answered]
    without_command = int(np.count_nonzero(~answered))
    if run.facts.get('mode') in WITHOUT_MIDDLEWARE:
        return np.zeros(0), without_command
    latency: Floats = (run.commands.published[index[answered]] - sent).astype(np.float64) * 1e-6
    return latency, without_command
