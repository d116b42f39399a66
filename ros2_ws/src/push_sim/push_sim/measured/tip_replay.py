"""Runs the commanded tip of a robot run or of a recording through the actuator model."""

import math

import numpy as np
from push_core.data import CommandedTip, RobotRun
from push_core.geometry import Array
from push_core.physics import Actuator, ActuatorSettings

_PERIOD = 0.002


def modelled_tip(run: RobotRun, settings: ActuatorSettings) -> Array:
    """Tip positions (n, 2) [m] of the actuator model at the times of a run.

    The robot took position commands, the model takes velocities. The commands are resampled to
    2 ms, because the rows jitter, and differenced. The model starts at the first sensed position.
    """
    grid = _PERIOD * np.arange(math.ceil(run.time[-1] / _PERIOD) + 1)
    command = np.column_stack([np.interp(grid, run.time, axis) for axis in run.commanded.T])
    command[0] = run.tip[0]
    reached = run.tip[0] + _travel(np.diff(command, axis=0) / _PERIOD, settings)
    return np.column_stack([np.interp(run.time, grid, axis) for axis in reached.T])


def tip_error(run: RobotRun, settings: ActuatorSettings) -> Array:
    """Modelled minus sensed tip (m, 2) [m], for the rows in which the tip follows commands."""
    return (modelled_tip(run, settings) - run.tip)[: run.following]


def recorded_tip_error(recorded: CommandedTip, settings: ActuatorSettings) -> Array:
    """Modelled minus measured tip (n, 2) [m], each about its mean.

    Where the tip was before the first pose is not known exactly, so a constant offset tells
    nothing.
    """
    actuator = Actuator(settings)
    travel, reached, now = np.zeros((len(recorded.time), 2)), np.zeros(2), 0.0
    commands = iter(zip(recorded.command_time.tolist(), recorded.command, strict=True))
    upcoming = next(commands, None)
    for row, time in enumerate(recorded.time.tolist()):
        while upcoming is not None and upcoming[0] <= time:
            actuator.command(upcoming[1], upcoming[0])
            upcoming = next(commands, None)
        reached += _advanced(actuator, now, time - now)
        travel[row], now = reached, time
    error = travel - recorded.tip
    return np.asarray(error - error.mean(axis=0))


def _advanced(actuator: Actuator, now: float, duration: float) -> Array:
    """Travel (2,) [m] over a time [s], in steps of at most 2 ms."""
    steps = max(1, math.ceil(duration / _PERIOD))
    step = duration / steps
    moved = [actuator.advance(now + number * step, step) for number in range(steps)]
    return np.asarray(step * np.sum(moved, axis=0))


def rms_coordinate(error: Array) -> float:
    """Root mean square over both coordinates of vectors (m, 2).

    The root mean square of their length is sqrt(2) times this.
    """
    return float(np.sqrt(np.mean(error**2)))


def _travel(velocities: Array, settings: ActuatorSettings) -> Array:
    """Travel (n + 1, 2) [m] of the tip under n velocity commands (n, 2), one for each period."""
    actuator = Actuator(settings)
    travel = [(0.0, 0.0)]
    for step, velocity in enumerate(velocities):
        actuator.command(velocity, step * _PERIOD)
        x, y = actuator.advance(step * _PERIOD, _PERIOD)
        travel.append((travel[-1][0] + x * _PERIOD, travel[-1][1] + y * _PERIOD))
    return np.array(travel)
