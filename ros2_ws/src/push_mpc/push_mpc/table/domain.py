"""The range of inputs that training data cover, and grids of queries over it."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array
from push_core.physics import GRAZING

from push_mpc.table.surrogate import Grid

SMALLEST = np.array([1e-3, 1e-2])
"""Smallest half width [m, rad] of a domain; a single push has none of its own."""


@dataclass(frozen=True)
class Domain:
    """A rectangle in [p_y, beta].

    Attributes:
        low: (2,) lowest p_y [m] and beta [rad].
        high: (2,) highest ones.
    """

    low: Array
    high: Array

    @classmethod
    def of_data(cls, p_y: tuple[float, float], beta: tuple[float, float], side: float) -> 'Domain':
        """The extent of training data, clipped to a face of length `side` [m]."""
        low, high = np.clip(p_y, -0.5 * side, 0.5 * side)
        ends = np.array([[low, beta[0]], [high, beta[1]]])
        middle, half = ends.mean(axis=0), np.maximum(0.5 * (ends[1] - ends[0]), SMALLEST)
        return cls(middle - half, middle + half)

    @classmethod
    def of_face(cls, side: float) -> 'Domain':
        """The whole face of length `side` [m] and all directions into it."""
        high = np.array([0.5 * side, np.pi - GRAZING])
        return cls(np.array([-high[0], GRAZING]), high)

    def covers(self, p_y: float, beta: float) -> bool:
        """Whether a push lies inside."""
        (p_low, b_low), (p_high, b_high) = self.low, self.high
        return bool(p_low <= p_y <= p_high and b_low <= beta <= b_high)

    def grid(self, size: tuple[int, int]) -> Grid:
        """An even grid over the domain."""
        return Grid(*(np.linspace(*ends) for ends in zip(self.low, self.high, size, strict=True)))

    def scattered(self, count: int) -> tuple[Array, Array]:
        """A low-discrepancy set of points that no grid shares: p_y and beta, each (count,).

        Source: Roberts 2018, the R2 sequence.
        """
        steps = np.array([0.7548776662466927, 0.5698402909980532])
        inside = np.mod(0.5 + steps * np.arange(1, count + 1)[:, None], 1.0)
        p_y, beta = (self.low + inside * (self.high - self.low)).T
        return p_y, beta
