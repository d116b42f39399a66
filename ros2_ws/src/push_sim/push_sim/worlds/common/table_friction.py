"""Friction of a table that varies with position and direction.

The variation over the table is a smooth Gaussian random field, a sum of waves with normally
distributed wave vectors, with covariance exp(-d^2 / (2 l^2)) at a distance d. Source: Rahimi and
Recht 2007. Anisotropy is an ellipse with its axes along world x and y.
"""

import math

import numpy as np
from push_core.physics import Pair

from push_sim.settings import WorldSettings

_WAVES = 256
_SMALLEST = 0.05
_STANDSTILL = 1e-6


class TableFriction:
    """The friction field of a seed."""

    def __init__(self, settings: WorldSettings, seed: int) -> None:
        random = np.random.default_rng([seed, 1])
        self._mean = settings.friction_ground
        self._waves = random.normal(0.0, 1.0 / settings.friction_length, (_WAVES, 2))
        self._phases = random.uniform(0.0, math.tau, _WAVES)
        self._amplitude = settings.friction_variation * math.sqrt(2.0 / _WAVES)
        self._root = math.sqrt(settings.friction_anisotropy)

    def coefficient(self, position: Pair, slip: Pair) -> float:
        """Friction coefficient at a position [m] for a slip velocity [m/s]."""
        return self._mean * self.relative(position) * self._in_direction(slip)

    def relative(self, position: Pair) -> float:
        """Friction at a position [m] divided by the mean of the table."""
        waves = np.cos(self._waves @ position + self._phases)
        return max(_SMALLEST, 1.0 + self._amplitude * float(waves.sum()))

    def _in_direction(self, slip: Pair) -> float:
        """Radius in the direction of slip of a friction ellipse with area pi."""
        speed = math.hypot(*slip)
        if speed < _STANDSTILL:
            return 1.0
        return speed / math.hypot(slip[0] / self._root, slip[1] * self._root)
