"""Friction of a table that is not the same everywhere and in every direction.

Over the table it varies by a smooth random field, a sum of waves whose lengths and directions are
normally distributed: so its covariance falls off as exp(-d^2 / (2 l^2)) with the distance d.
Source: Rahimi and Recht 2007. Along world x it may be stronger than along y, on an ellipse.
"""

import math

import numpy as np
from push_core.physics import Pair

from push_sim.settings import WorldSettings

_WAVES = 256
_LEAST = 0.05
_STANDSTILL = 1e-6


class TableFriction:
    """One table, as a seed gives it."""

    def __init__(self, settings: WorldSettings, seed: int) -> None:
        random = np.random.default_rng([seed, 1])
        self._mean = settings.friction_ground
        self._waves = random.normal(0.0, 1.0 / settings.friction_length, (_WAVES, 2))
        self._phases = random.uniform(0.0, math.tau, _WAVES)
        self._height = settings.friction_variation * math.sqrt(2.0 / _WAVES)
        self._root = math.sqrt(settings.friction_anisotropy)

    def coefficient(self, place: Pair, slip: Pair) -> float:
        """Friction coefficient at a place [m] that slips with a velocity [m/s]."""
        return self._mean * self.relative(place) * self._in_direction(slip)

    def relative(self, place: Pair) -> float:
        """Friction at a place [m] over the mean of the table."""
        waves = np.cos(self._waves @ place + self._phases)
        return max(_LEAST, 1.0 + self._height * float(waves.sum()))

    def _in_direction(self, slip: Pair) -> float:
        """Radius of the friction ellipse, of area pi, in the direction of slip."""
        speed = math.hypot(*slip)
        if speed < _STANDSTILL:
            return 1.0
        return speed / math.hypot(slip[0] / self._root, slip[1] * self._root)
