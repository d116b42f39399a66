"""The pushes that a model was trained on span a domain, which is not always where it is asked."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

from push_mpc.table.surrogate import Grid

SMALLEST = np.array([1e-3, 1e-2])
"""Half the extent [m, rad] that even a single push spans."""

GRAZING = 0.01
"""Angle [rad] to the face below which a tip no longer pushes."""


@dataclass(frozen=True)
class Domain:
    """A rectangle of pushes.

    Attributes:
        low: (2,) lowest p_y [m] and beta [rad].
        high: (2,) highest ones.
    """

    low: Array
    high: Array

    @classmethod
    def of_data(cls, p_y: tuple[float, float], beta: tuple[float, float], side: float) -> 'Domain':
        """From the extent of the training data, as far as it lies on the face of a side [m]."""
        low, high = np.clip(p_y, -0.5 * side, 0.5 * side)
        ends = np.array([[low, beta[0]], [high, beta[1]]])
        middle, half = ends.mean(axis=0), np.maximum(0.5 * (ends[1] - ends[0]), SMALLEST)
        return cls(middle - half, middle + half)

    @classmethod
    def of_face(cls, side: float) -> 'Domain':
        """The whole face of a side [m], and all directions into it."""
        high = np.array([0.5 * side, np.pi - GRAZING])
        return cls(np.array([-high[0], GRAZING]), high)

    def covers(self, p_y: float, beta: float) -> bool:
        """Whether a push lies within."""
        (p_low, b_low), (p_high, b_high) = self.low, self.high
        return bool(p_low <= p_y <= p_high and b_low <= beta <= b_high)

    def grid(self, size: tuple[int, int]) -> Grid:
        """An even grid over all of it."""
        return Grid(*(np.linspace(*ends) for ends in zip(self.low, self.high, size, strict=True)))

    def scattered(self, count: int) -> tuple[Array, Array]:
        """Even without a pattern that a grid could share: (count,) p_y and (count,) beta.

        Source: Roberts 2018, the R2 sequence.
        """
        steps = np.array([0.7548776662466927, 0.5698402909980532])
        inside = np.mod(0.5 + steps * np.arange(1, count + 1)[:, None], 1.0)
        p_y, beta = (self.low + inside * (self.high - self.low)).T
        return p_y, beta
