"""The dead time and lag that bring the commanded tip of a robot run nearest to the sensed one."""

from dataclasses import dataclass, replace

import numpy as np
from push_core.geometry import Array
from push_core.physics import ActuatorSettings
from scipy.optimize import least_squares

from push_sim.fitting.bootstrap import bootstrap_deviation
from push_sim.measured import RobotRun, tip_gap

_LARGEST = 0.5
_SMALLEST = 1e-4
_BLOCK = 250


@dataclass(frozen=True)
class ActuatorFit:
    """What was found.

    Attributes:
        settings: the actuator with its dead time and lag replaced.
        residual: (n, 2) from the sensed tip to the model's [m].
        jacobian: (n, 2, 2) its derivatives by dead time and lag [m/s].
    """

    settings: ActuatorSettings
    residual: Array
    jacobian: Array

    def deviation(self, seed: int) -> Array:
        """Standard deviations (2,) of dead time and lag [s], by drawing half seconds of the run.

        Rows next to each other tell the same, so they are drawn together.
        """
        blocks = max(2, len(self.residual) // _BLOCK)
        rows = blocks * (len(self.residual) // blocks)
        return bootstrap_deviation(
            self.residual[:rows].reshape(blocks, -1),
            self.jacobian[:rows].reshape(blocks, -1, 2),
            seed,
        )


def fitted_actuator(run: RobotRun, start: ActuatorSettings) -> ActuatorFit:
    """Least squares of the distance between the model's tip and the sensed one.

    Args:
        run: with as much motion as the lag is to be told from.
        start: where the search begins; its limits are kept.
    """
    found = least_squares(
        lambda times: tip_gap(run, _with_times(start, times)).ravel(),
        np.clip([start.dead_time, start.lag], _SMALLEST, _LARGEST),
        bounds=(0.0, _LARGEST),
        x_scale=0.01,
        diff_step=0.02,
        xtol=1e-6,
    )
    settings = _with_times(start, found.x)
    return ActuatorFit(settings, found.fun.reshape(-1, 2), found.jac.reshape(-1, 2, 2))


def _with_times(settings: ActuatorSettings, times: Array) -> ActuatorSettings:
    dead_time, lag = times.tolist()
    return replace(settings, dead_time=dead_time, lag=lag)
