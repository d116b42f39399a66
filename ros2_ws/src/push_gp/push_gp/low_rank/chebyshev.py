"""Chebyshev expansions on an interval, and the intervals of the two inputs.

The squared exponential kernel is so smooth that a few dozen polynomials represent it to round-off.
Source: Trefethen, Approximation Theory and Approximation Practice, 2013, chapters 3 and 8.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.chebyshev import chebpts1, chebvander
from push_core.data import P_Y_LIMIT
from push_core.geometry import Array

SPARE, PER_LENGTHSCALE = 20, 11
"""Polynomials that always suffice: this number, plus so many for each lengthscale in the half
width."""

CENTRE = np.array([0.0, math.pi / 2.0])
HALF_WIDTH = np.array([P_Y_LIMIT, math.pi / 2.0]) * 1.001
"""Every push, and every query of the controller, lies within CENTRE +- HALF_WIDTH [m, rad]."""


@dataclass(frozen=True)
class Interval:
    """The interval centre +- half width."""

    centre: float
    half_width: float

    @classmethod
    def around(cls, points: Array) -> 'Interval':
        """The smallest interval that holds the points (n,); its width is never zero."""
        low, high = float(points.min()), float(points.max())
        return cls(0.5 * (low + high), max(0.5 * (high - low), 1e-6))

    def polynomials(self, points: Array, count: int) -> Array:
        """Values (n, count) of the first Chebyshev polynomials at points (n,)."""
        return chebvander((points - self.centre) / self.half_width, count - 1)

    def enough(self, lengthscale: float) -> int:
        """Number of polynomials that represent a kernel of this lengthscale to round-off."""
        return SPARE + int(PER_LENGTHSCALE * self.half_width / lengthscale)

    def nodes(self, count: int) -> Array:
        """Interpolation points (count,)."""
        return np.asarray(self.centre + self.half_width * chebpts1(count))

    @staticmethod
    def transform(count: int) -> Array:
        """Matrix (count, count) from values at the nodes to Chebyshev coefficients."""
        transform = chebvander(chebpts1(count), count - 1).T * (2.0 / count)
        transform[0] *= 0.5
        return np.asarray(transform)

    def kernel(self, lengthscale: float, count: int) -> tuple[Array, Array]:
        """Coefficients (count, count) of the kernel k(x, x') in polynomials of x and of x'.

        Returns:
            Those of exp(-(x - x')^2 / l^2), and of its derivative with respect to log l.
        """
        nodes, transform = self.nodes(count), self.transform(count)
        exponent = ((nodes[:, None] - nodes) / lengthscale) ** 2
        values = np.exp(-exponent)
        slopes = 2.0 * exponent * values
        return transform @ values @ transform.T, transform @ slopes @ transform.T


INTERVALS = tuple(
    Interval(*each) for each in zip(CENTRE.tolist(), HALF_WIDTH.tolist(), strict=True)
)
"""Of p_y [m] and of beta [rad]."""


def covers(queries: Array) -> bool:
    """Whether all (m, 2) queries lie within `INTERVALS`."""
    return bool((np.abs(queries - CENTRE) <= HALF_WIDTH).all())
