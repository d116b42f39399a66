"""How long the loop took.

pose to command = publish time of a command - publish time of the pose that carries its stamp;
a deadline miss is a pose in TRACKING whose command came more than DEADLINE later, or never.
A run in one process or from a file has no middleware and therefore no pose to command.
"""

from dataclasses import dataclass

import numpy as np
from push_msgs.msg import ControllerState

from push_bag.run import Floats, RunSeries
from push_bag.score.tracking import during_tracking

DEADLINE = 0.010  # [s]
WITHOUT_MIDDLEWARE = ('inprocess', 'robot')  # the fact `mode` of such runs


@dataclass(frozen=True)
class LoopTiming:
    """Times of the ticks in TRACKING [ms].

    Attributes:
        solve: (n,) of the quadratic program.
        tick: (n,) pose received to command published, by the controller's clock.
        pose_to_command: (m,) over the middleware, of the poses that were answered; empty for a
            run in one process.
        deadline_misses: poses answered too late or never.
    """

    solve: Floats
    tick: Floats
    pose_to_command: Floats
    deadline_misses: int


def timing(run: RunSeries) -> LoopTiming:
    """The times of a run."""
    ticks = run.state('mode') == ControllerState.TRACKING
    latency, unanswered = _answers(run)
    late = int(np.count_nonzero(latency > DEADLINE * 1e3))
    solve, tick = (_measured(run.state(name)[ticks]) for name in ('solve_ms', 'tick_ms'))
    return LoopTiming(solve, tick, latency, late + unanswered)


def _measured(times: Floats) -> Floats:
    """Without the ticks that nobody timed, as in a run of the real cell."""
    return times[np.isfinite(times)]


def _answers(run: RunSeries) -> tuple[Floats, int]:
    """Latency (m,) [ms] of each answered pose in TRACKING, and how many had no answer."""
    tracked = during_tracking(run, run.object.stamp)
    index, answered = run.commands.at(run.object.stamp[tracked])
    sent = run.object.published[tracked][answered]
    unanswered = int(np.count_nonzero(~answered))
    if run.facts.get('mode') in WITHOUT_MIDDLEWARE:
        return np.zeros(0), unanswered
    latency: Floats = (run.commands.published[index[answered]] - sent).astype(np.float64) * 1e-6
    return latency, unanswered
