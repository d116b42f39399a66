"""A robot run cut into windows of half a second, each on its own."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

from push_sim.measured.robot_run import RobotRun
from push_sim.worlds import SUBSTEP

WINDOW = 0.5
"""Length of a window [s]."""

INTERVAL = 2 * SUBSTEP
"""Time [s] between the tip positions that a window keeps."""


@dataclass(frozen=True)
class Windows:
    """n windows with k tip positions each.

    Attributes:
        start: (n, 3) measured object pose at the start of each [m, m, rad].
        end: (n, 3) measured object pose at its end.
        tip: (n, k, 2) sensed tip, every `INTERVAL` [m].
    """

    start: Array
    end: Array
    tip: Array


def windows(run: RobotRun) -> Windows:
    """The whole windows of a run, one after the other, from its first row on."""
    points = round(WINDOW / INTERVAL)
    count = int((run.time[-1] + 1e-9) / WINDOW)
    edges = WINDOW * np.arange(count + 1)
    poses = _at(run.time, run.object_pose, edges)
    times = edges[:-1, None] + INTERVAL * np.arange(points + 1)
    tip = _at(run.time, run.sensed, times.ravel()).reshape(count, points + 1, 2)
    return Windows(poses[:-1], poses[1:], tip)


def _at(time: Array, values: Array, wanted: Array) -> Array:
    """Values (n, m) at wanted times (k,), linear between rows."""
    return np.column_stack([np.interp(wanted, time, column) for column in values.T])
