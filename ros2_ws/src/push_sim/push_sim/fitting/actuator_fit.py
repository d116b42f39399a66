"""Fits dead time and lag of the actuator model to the tip of a robot run."""

from dataclasses import dataclass, replace

import numpy as np
from push_core.data import RobotRun
from push_core.geometry import Array
from push_core.physics import ActuatorSettings
from scipy.optimize import least_squares

from push_sim.fitting.bootstrap import bootstrap_deviation
from push_sim.measured import tip_error

_LARGEST = 0.5
_SMALLEST = 1e-4
_BLOCK = 250


@dataclass(frozen=True)
class ActuatorFit:
    """A fitted actuator.

    Attributes:
        settings: the actuator with fitted dead time and lag.
        residual: (n, 2) modelled minus sensed tip [m].
        jacobian: (n, 2, 2) derivatives of the residual by dead time and lag [m/s].
    """

    settings: ActuatorSettings
    residual: Array
    jacobian: Array

    def deviation(self, seed: int) -> Array:
        """Standard deviations (2,) of dead time and lag [s], by a block bootstrap.

        A block is half a second, because the errors of adjacent rows are correlated.
        """
        blocks = max(2, len(self.residual) // _BLOCK)
        rows = blocks * (len(self.residual) // blocks)
        return bootstrap_deviation(
            self.residual[:rows].reshape(blocks, -1),
            self.jacobian[:rows].reshape(blocks, -1, 2),
            seed,
        )


def fit_actuator(run: RobotRun, start: ActuatorSettings) -> ActuatorFit:
    """Minimises the squared distance between modelled and sensed tip.

    Args:
        run: must contain enough motion to identify the lag.
        start: initial guess; its limits are kept.
    """
    result = least_squares(
        lambda times: tip_error(run, _with_times(start, times)).ravel(),
        np.clip([start.dead_time, start.lag], _SMALLEST, _LARGEST),
        bounds=(0.0, _LARGEST),
        x_scale=0.01,
        diff_step=0.02,
        xtol=1e-6,
    )
    settings = _with_times(start, result.x)
    return ActuatorFit(settings, result.fun.reshape(-1, 2), result.jac.reshape(-1, 2, 2))


def _with_times(settings: ActuatorSettings, times: Array) -> ActuatorSettings:
    dead_time, lag = times.tolist()
    return replace(settings, dead_time=dead_time, lag=lag)
