"""The squared exponential kernel as a short sum of products: k(a, b) = s(a)^T s(b).

The functions s are the modes (eigenfunctions) of the kernel over the domain: the shortest
expansion that reproduces the kernel to round-off. Source: Rasmussen and Williams 2006, section
4.3.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

from push_gp.low_rank.chebyshev import Interval

ROUND_OFF = 1e-15
"""Terms of the kernel of unit signal that are below double precision."""


@dataclass(frozen=True)
class KernelModes:
    """Products of the modes of p_y and of beta at given lengthscales.

    Attributes:
        intervals: of both inputs.
        modes: for each input, (m, k) orthonormal modes as Chebyshev coefficients.
        values: for each input, (k,) eigenvalues of the modes.
        products: (2, r) indices of the two modes in each product.
    """

    intervals: Sequence[Interval]
    modes: tuple[Array, Array]
    values: tuple[Array, Array]
    products: Array

    @classmethod
    def of(
        cls,
        intervals: Sequence[Interval],
        lengthscales: Sequence[float],
        cut_off: float = ROUND_OFF,
    ) -> 'KernelModes':
        """The modes above a threshold.

        Args:
            intervals: domains of the two inputs.
            lengthscales: of the two inputs.
            cut_off: smallest term of the kernel of unit signal that is kept.
        """
        (first, across), (second, around) = (
            _modes(interval.kernel(lengthscale, interval.enough(lengthscale))[0], cut_off)
            for interval, lengthscale in zip(intervals, lengthscales, strict=True)
        )
        products = np.array(np.nonzero(np.outer(first, second) > cut_off))
        return cls(intervals, (across, around), (first, second), products)

    def __len__(self) -> int:
        return int(self.products.shape[1])

    def products_at(self, points: Array) -> Array:
        """Products (n, r) of the unscaled modes at (n, 2) points."""
        first, second = (
            (interval.polynomials(column, len(modes)) @ modes)[:, chosen]
            for interval, column, modes, chosen in zip(
                self.intervals, points.T, self.modes, self.products, strict=True
            )
        )
        first *= second
        return np.asarray(first)

    def features(self, points: Array) -> Array:
        """Features (n, r) at (n, 2) points; their inner products are the kernel of unit signal."""
        first, second = (
            values[chosen] for values, chosen in zip(self.values, self.products, strict=True)
        )
        return np.asarray(self.products_at(points) * np.sqrt(first * second))


def _modes(kernel: Array, cut_off: float) -> tuple[Array, Array]:
    """Eigenvalues (k,) above `cut_off` of coefficients (m, m), and their vectors (m, k)."""
    values, vectors = np.linalg.eigh(kernel)
    kept = values > cut_off
    return values[kept], vectors[:, kept]
