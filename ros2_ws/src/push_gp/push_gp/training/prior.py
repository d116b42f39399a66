"""Priors of the hyperparameters.

With a few pushes noise and signal cannot be separated: without a prior the likelihood then prefers
lengthscales of zero or infinity. These log-normal priors weigh as much as a few pushes. `fit`
applies them in full up to 300 pushes and less with more. They are given in units in which pushing
is of order one: half a face, a radian, the distance of the push.
"""

from dataclasses import dataclass

import numpy as np
from push_core.data import HALF_FACE
from push_core.geometry import Array


@dataclass(frozen=True)
class Prior:
    """Independent log-normal priors of [lengthscale p_y, lengthscale beta, signal, noise].

    Attributes:
        centre: (4,) logarithms of the most likely values [m, rad, unit of the output, same].
        width: (4,) standard deviations of the logarithms.
        low: (4,) logarithms of the smallest values allowed.
        high: (4,) logarithms of the largest values allowed.
    """

    centre: Array
    width: Array
    low: Array
    high: Array

    def with_gradient(self, logarithms: Array) -> tuple[float, Array]:
        """Log density [nat] without its constant, and its gradient (4,)."""
        offset = (logarithms - self.centre) / self.width
        return float(-0.5 * offset @ offset), -offset / self.width


@dataclass(frozen=True)
class PriorValues:
    """Priors of the processes of dx, dy and dtheta, in half faces, radians and distances.

    Attributes:
        centre: (3, 4) most likely lengthscale p_y, lengthscale beta, signal and noise.
        width: (4,) standard deviations of their logarithms.
    """

    centre: Array
    width: Array


OVER_ZERO = PriorValues(
    centre=np.array([[0.7, 1.8, 0.5, 0.05], [0.5, 1.0, 0.15, 0.05], [0.5, 1.1, 0.3, 0.05]]),
    width=np.array([0.3, 0.3, 0.5, 0.7]),
)
"""Over a zero mean: the order of magnitude of quasi-static pushing."""

OVER_CONE = PriorValues(
    centre=np.array([[0.4, 0.7, 0.03, 0.08], [0.4, 0.7, 0.03, 0.08], [0.4, 0.7, 0.04, 0.08]]),
    width=np.array([0.3, 0.3, 0.4, 0.5]),
)
"""Over the motion cone, for its residuals: a signal below the noise, so that a few pushes do not
distort a mean that is nearly right already."""

LOW = np.array([0.05, 0.05, 1e-3, 1e-3])
HIGH = np.array([20.0, 20.0, 30.0, 1.0])


def priors(values: PriorValues, distance: float) -> list[Prior]:
    """One prior for each output, for pushes of a `distance` [m]."""
    turn = distance / HALF_FACE
    units = [np.log([HALF_FACE, 1.0, unit, unit]) for unit in (distance, distance, turn)]
    return [
        Prior(np.log(centre) + unit, values.width, np.log(LOW) + unit, np.log(HIGH) + unit)
        for centre, unit in zip(values.centre, units, strict=True)
    ]
