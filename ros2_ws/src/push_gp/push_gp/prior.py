"""What is believed of the hyperparameters before any push is seen.

A handful of pushes cannot tell noise from signal; without a prior the likelihood then prefers
lengthscales of zero or of infinity. These log-normal priors are wide and weigh as much as a few
pushes: from about a hundred pushes on they are not noticed. They are stated in units in which
pushing is of the order of one: half a face, a radian, the distance of the push.
"""

from dataclasses import dataclass

import numpy as np
from push_core.frames import Array
from push_core.push_set import HALF_FACE


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


ZERO_MEAN = np.array([[0.7, 1.8, 0.5, 0.05], [0.5, 1.0, 0.15, 0.05], [0.5, 1.1, 0.3, 0.05]])
CONE_MEAN = np.array([[0.4, 0.7, 0.06, 0.05], [0.4, 0.7, 0.06, 0.05], [0.4, 0.7, 0.08, 0.05]])
"""Per output dx, dy, dtheta, in units of half a face, a radian and the distance: the rounded order
of magnitude of quasi-static pushing, and of what the motion cone leaves of it."""

WIDTH = np.array([0.5, 0.5, 0.7, 1.0])
LOW = np.array([0.05, 0.05, 1e-3, 1e-3])
HIGH = np.array([20.0, 20.0, 30.0, 1.0])


def priors(centres: Array, distance: float) -> list[Prior]:
    """One prior per output for pushes of a `distance` [m].

    Args:
        centres: (3, 4) `ZERO_MEAN` or `CONE_MEAN`.
        distance: travel of the pusher in each push [m].
    """
    turn = distance / HALF_FACE
    units = [np.log([HALF_FACE, 1.0, unit, unit]) for unit in (distance, distance, turn)]
    return [
        Prior(np.log(centre) + unit, WIDTH, np.log(LOW) + unit, np.log(HIGH) + unit)
        for centre, unit in zip(centres, units, strict=True)
    ]
