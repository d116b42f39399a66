"""Functions of one input on an interval as sums of Chebyshev polynomials.

The squared exponential kernel is so smooth that a few dozen polynomials give it to round-off.
Source: Trefethen, Approximation Theory and Approximation Practice, 2013, chapters 3 and 8.
"""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

SPARE, PER_LENGTHSCALE = 20, 11
"""Polynomials that surely suffice: so many, and more for each lengthscale in the half width."""


@dataclass(frozen=True)
class Interval:
    """Where a function lives: centre +- half width."""

    centre: float
    half_width: float

    @classmethod
    def around(cls, points: Array) -> 'Interval':
        """The smallest interval that holds the points (n,); never without width."""
        low, high = float(points.min()), float(points.max())
        return cls(0.5 * (low + high), max(0.5 * (high - low), 1e-6))

    def polynomials(self, points: Array, count: int) -> Array:
        """Values (n, count) of the first Chebyshev polynomials at points (n,)."""
        unit = np.clip((points - self.centre) / self.half_width, -1.0, 1.0)
        return np.asarray(np.cos(np.arccos(unit)[:, None] * np.arange(count)))

    def enough(self, lengthscale: float) -> int:
        """Polynomials that give a kernel of this lengthscale to round-off."""
        return SPARE + int(PER_LENGTHSCALE * self.half_width / lengthscale)

    def nodes(self, count: int) -> Array:
        """(count,) places whose values fix as many polynomials."""
        return np.asarray(self.centre + self.half_width * np.cos(_angles(count)))

    @staticmethod
    def transform(count: int) -> Array:
        """(count, count) matrix that makes coefficients of the values at the nodes."""
        transform = np.cos(np.arange(count)[:, None] * _angles(count)) * (2.0 / count)
        transform[0] *= 0.5
        return np.asarray(transform)

    def kernel(self, lengthscale: float, count: int) -> tuple[Array, Array]:
        """Coefficients (count, count) of the kernel, polynomials of one point by the other's.

        Returns:
            Those of exp(-(x - x')^2 / l^2), and of its derivative by the logarithm of l.
        """
        nodes, transform = self.nodes(count), self.transform(count)
        exponent = ((nodes[:, None] - nodes) / lengthscale) ** 2
        values = np.exp(-exponent)
        slopes = 2.0 * exponent * values
        return transform @ values @ transform.T, transform @ slopes @ transform.T


def _angles(count: int) -> Array:
    return np.asarray(np.pi * (np.arange(count) + 0.5) / count)
