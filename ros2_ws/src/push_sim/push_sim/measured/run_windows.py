"""Cuts a robot run into windows of 0.5 s that are simulated independently."""

from dataclasses import dataclass

import numpy as np
from push_core.data import RobotRun
from push_core.geometry import Array

from push_sim.worlds import COARSE_SUBSTEP

WINDOW = 0.5
"""Length of a window [s]."""

INTERVAL = 2 * COARSE_SUBSTEP
"""Time [s] between the tip positions of a window."""


@dataclass(frozen=True)
class Windows:
    """n windows with k tip positions each.

    Attributes:
        start: (n, 3) measured object pose at the start of each window [m, m, rad].
        end: (n, 3) measured object pose at its end [m, m, rad].
        tip: (n, k, 2) sensed tip position, every `INTERVAL` [m].
    """

    start: Array
    end: Array
    tip: Array


def cut_windows(run: RobotRun) -> Windows:
    """The consecutive complete windows of a run, from its first row on."""
    points = round(WINDOW / INTERVAL)
    count = int((run.time[-1] + 1e-9) / WINDOW)
    edges = WINDOW * np.arange(count + 1)
    poses = _interpolated(run.time, run.pose, edges)
    times = edges[:-1, None] + INTERVAL * np.arange(points + 1)
    tip = _interpolated(run.time, run.tip, times.ravel()).reshape(count, points + 1, 2)
    return Windows(poses[:-1], poses[1:], tip)


def _interpolated(time: Array, values: Array, times: Array) -> Array:
    """Values (n, m) at other times (k,), linear between rows."""
    return np.column_stack([np.interp(times, time, column) for column in values.T])
