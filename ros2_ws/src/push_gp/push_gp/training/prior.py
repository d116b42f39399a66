"""What is believed of the hyperparameters before any push is seen.

A handful of pushes cannot tell noise from signal; without a prior the likelihood then prefers
lengthscales of zero or of infinity. These log-normal priors weigh as much as a few pushes; from
about a hundred pushes on they are not noticed. They are stated in units in which
pushing is of the order of one: half a face, a radian, the distance of the push.
"""

from dataclasses import dataclass

import numpy as np
from push_core.data import HALF_FACE
from push_core.geometry import Array


@dataclass(frozen=True)
class Prior:
    """Independent log-normal beliefs about [lengthscale p_y, lengthscale beta, signal, noise].

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
class Beliefs:
    """About the processes of dx, dy and dtheta, in units of half a face, a radian and a distance.

    Attributes:
        centre: (3, 4) most likely lengthscale p_y, lengthscale beta, signal and noise.
        width: (4,) standard deviations of their logarithms.
    """

    centre: Array
    width: Array


OVER_ZERO = Beliefs(
    centre=np.array([[0.7, 1.8, 0.5, 0.05], [0.5, 1.0, 0.15, 0.05], [0.5, 1.1, 0.3, 0.05]]),
    width=np.array([0.3, 0.3, 0.5, 0.7]),
)
"""The order of magnitude of quasi-static pushing itself."""

OVER_CONE = Beliefs(
    centre=np.array([[0.4, 0.7, 0.03, 0.08], [0.4, 0.7, 0.03, 0.08], [0.4, 0.7, 0.04, 0.08]]),
    width=np.array([0.3, 0.3, 0.4, 0.5]),
)
"""What the motion cone leaves: less than the noise until enough pushes say otherwise, so that a
handful of them does no harm to a mean that is nearly right already."""

LOW = np.array([0.05, 0.05, 1e-3, 1e-3])
HIGH = np.array([20.0, 20.0, 30.0, 1.0])


def priors(beliefs: Beliefs, distance: float) -> list[Prior]:
    """One prior per output for pushes of a `distance` [m]."""
    turn = distance / HALF_FACE
    units = [np.log([HALF_FACE, 1.0, unit, unit]) for unit in (distance, distance, turn)]
    return [
        Prior(np.log(centre) + unit, beliefs.width, np.log(LOW) + unit, np.log(HIGH) + unit)
        for centre, unit in zip(beliefs.centre, units, strict=True)
    ]
