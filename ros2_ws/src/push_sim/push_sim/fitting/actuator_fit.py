"""Fits dead time and lag of the actuator model to the tip of a robot run or a recording."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from push_core.data import CommandedTip, RobotRun
from push_core.geometry import Array
from push_core.physics import ActuatorSettings
from scipy.optimize import least_squares

from push_sim.fitting.bootstrap import bootstrap_deviation
from push_sim.measured import recorded_tip_error, tip_error

_LARGEST = 0.5
_SMALLEST = 1e-4
_BLOCK = 0.5  # [s]


@dataclass(frozen=True)
class ActuatorFit:
    """A fitted actuator.

    Attributes:
        settings: the actuator with fitted dead time and lag.
        residual: (n, 2) modelled minus sensed tip [m].
        jacobian: (n, 2, 2) derivatives of the residual by dead time and lag [m/s].
        duration: of the measurement [s].
    """

    settings: ActuatorSettings
    residual: Array
    jacobian: Array
    duration: float

    def deviation(self, seed: int) -> Array:
        """Standard deviations (2,) of dead time and lag [s], by a block bootstrap.

        A block is half a second, because the errors of adjacent rows are correlated.
        """
        blocks = max(2, int(self.duration / _BLOCK))
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
    return _fitted(partial(tip_error, run), start, float(run.time[run.following - 1]))


def fit_recorded(recorded: CommandedTip, start: ActuatorSettings) -> ActuatorFit:
    """The same for the tip of a recording.

    Args:
        recorded: must contain changes of the velocity, which alone tell dead time from lag.
        start: initial guess; its limits are kept.
    """
    duration = float(recorded.time[-1] - recorded.time[0])
    return _fitted(partial(recorded_tip_error, recorded), start, duration)


def _fitted(
    error: Callable[[ActuatorSettings], Array], start: ActuatorSettings, duration: float
) -> ActuatorFit:
    result = least_squares(
        lambda times: error(_with_times(start, times)).ravel(),
        np.clip([start.dead_time, start.lag], _SMALLEST, _LARGEST),
        bounds=(0.0, _LARGEST),
        x_scale=0.01,
        diff_step=0.02,
        xtol=1e-6,
    )
    settings = _with_times(start, result.x)
    residual, jacobian = result.fun.reshape(-1, 2), result.jac.reshape(-1, 2, 2)
    return ActuatorFit(settings, residual, jacobian, duration)


def _with_times(settings: ActuatorSettings, times: Array) -> ActuatorSettings:
    dead_time, lag = times.tolist()
    return replace(settings, dead_time=dead_time, lag=lag)
