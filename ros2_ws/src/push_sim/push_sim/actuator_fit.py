"""The dead time and lag that bring the commanded tip of robot runs nearest to the sensed one."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from push_core.actuator import ActuatorSettings
from push_core.frames import Array
from scipy.optimize import least_squares

from push_sim.robot_run import RobotRun
from push_sim.tip_replay import tip_gap

_LARGEST = 0.5
_SMALLEST = 1e-4


@dataclass(frozen=True)
class ActuatorFit:
    """What was found.

    Attributes:
        settings: the actuator with its dead time and lag replaced.
        covariance: (2, 2) of dead time and lag [s^2], by the curvature at the optimum.
    """

    settings: ActuatorSettings
    covariance: Array


def fitted_actuator(runs: Sequence[RobotRun], start: ActuatorSettings) -> ActuatorFit:
    """Least squares of the distance between the model's tip and the sensed one.

    Args:
        runs: at least one.
        start: where the search begins; its limits are kept.
    """

    def apart(times: Array) -> Array:
        settings = _with_times(start, times)
        return np.concatenate([tip_gap(run, settings).ravel() for run in runs])

    found = least_squares(
        apart,
        np.clip([start.dead_time, start.lag], _SMALLEST, _LARGEST),
        bounds=(0.0, _LARGEST),
        x_scale=0.01,
        diff_step=0.02,
        xtol=1e-6,
    )
    variance = 2.0 * found.cost / max(1, found.fun.size - 2)
    covariance = variance * np.linalg.pinv(found.jac.T @ found.jac)
    return ActuatorFit(_with_times(start, found.x), covariance)


def _with_times(settings: ActuatorSettings, times: Array) -> ActuatorSettings:
    dead_time, lag = times.tolist()
    return replace(settings, dead_time=dead_time, lag=lag)
