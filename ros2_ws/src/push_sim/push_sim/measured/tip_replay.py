"""The commanded tip of a robot run through the actuator model."""

import math

import numpy as np
from push_core.geometry import Array
from push_core.physics import Actuator, ActuatorSettings

from push_sim.measured.robot_run import RobotRun

_PERIOD = 0.002


def commanded_tip(run: RobotRun, settings: ActuatorSettings) -> Array:
    """Where the model brings the tip (n, 2) [m], at the times of a run.

    The robot was commanded by position, the model takes velocities: those that lead from one
    commanded position to the next, on an even grid of 2 ms, since the rows jitter. It sets out
    from where the tip was.
    """
    grid = _PERIOD * np.arange(math.ceil(run.time[-1] / _PERIOD) + 1)
    wanted = np.column_stack([np.interp(grid, run.time, axis) for axis in run.commanded.T])
    wanted[0] = run.sensed[0]
    reached = run.sensed[0] + _moved(np.diff(wanted, axis=0) / _PERIOD, settings)
    return np.column_stack([np.interp(run.time, grid, axis) for axis in reached.T])


def tip_gap(run: RobotRun, settings: ActuatorSettings) -> Array:
    """From the sensed tip to the model's (m, 2) [m], in the rows in which the tip followed."""
    return (commanded_tip(run, settings) - run.sensed)[: run.following]


def rms_coordinate(gap: Array) -> float:
    """Root mean squared coordinate of vectors (m, 2), as the runs' figures are stated.

    The root mean squared length is the square root of two times this.
    """
    return float(np.sqrt(np.mean(gap**2)))


def _moved(velocities: Array, settings: ActuatorSettings) -> Array:
    """Way (n + 1, 2) [m] of the tip under n velocity commands, each for one period."""
    actuator = Actuator(settings)
    ways = [(0.0, 0.0)]
    for step, velocity in enumerate(velocities):
        actuator.command(velocity, step * _PERIOD)
        x, y = actuator.advance(step * _PERIOD, _PERIOD)
        ways.append((ways[-1][0] + x * _PERIOD, ways[-1][1] + y * _PERIOD))
    return np.array(ways)
