"""Ellipsoidal limit surface: relation of friction wrench and twist of a sliding object.

H(w) = 1/2 w^T diag(1/f^2, 1/f^2, 1/m^2) w, and the twist is along its gradient (Goyal et al. 1991;
Hogan and Rodriguez 2016, eq. 3).
"""

import math
from dataclasses import dataclass

import numpy as np

from push_core.geometry import Array
from push_core.physics.slider import Slider

GRAVITY = 9.81


def uniform_pressure_radius(side: float) -> float:
    """Moment over force, c = m/f [m], of a square of side [m] with uniform pressure."""
    return side * (math.sqrt(2.0) + math.log(1.0 + math.sqrt(2.0))) / 6.0


@dataclass(frozen=True)
class LimitSurface:
    """The ellipsoid with the given half axes.

    Attributes:
        force: largest friction force f [N].
        moment: largest friction moment m [N m].
    """

    force: float
    moment: float

    @classmethod
    def of(cls, slider: Slider) -> 'LimitSurface':
        """The limit surface of a slider under its own weight."""
        force = slider.friction_ground * slider.mass * GRAVITY
        return cls(force, slider.support_radius * force)

    @property
    def weights(self) -> Array:
        """Diagonal (3,) of the quadratic form: [1/f^2, 1/f^2, 1/m^2]."""
        return np.array([self.force**-2, self.force**-2, self.moment**-2])

    def value(self, wrench: Array) -> Array:
        """H(w) of wrenches (..., 3) [N, N, N m]; 1/2 on the surface."""
        return np.asarray(0.5 * np.sum(self.weights * np.square(wrench), axis=-1))

    def twist(self, wrench: Array) -> Array:
        """Gradient of H, the direction of the twist (..., 3), for wrenches (..., 3)."""
        return np.asarray(self.weights * wrench)
