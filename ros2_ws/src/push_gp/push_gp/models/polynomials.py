"""Functions of p_y and beta as sums of products of Chebyshev polynomials.

An answer is two matrix products, without a single exponential.
"""

import numpy as np
from numpy.polynomial.chebyshev import chebder
from push_core.geometry import Array

from push_gp.low_rank import CENTRE, COVERED

QUERIES_AT_ONCE = 1024
"""So few that what is worked on stays in the cache of one core."""


class Polynomials:
    """The values and slopes of k functions within the domain."""

    def __init__(self, coefficients: Array) -> None:
        """Takes coefficients (k, p, q): functions by polynomials of p_y and of beta."""
        self._outputs, self._across, self._around = coefficients.shape
        self._table = _with_slopes(coefficients)

    @property
    def size(self) -> int:
        """Polynomials in both inputs, to which the cost of an answer is proportional."""
        return int(self._across * self._around)

    def evaluate(self, queries: Array) -> tuple[Array, Array]:
        """Values (m, k) and Jacobian (m, k, 2) at (m, 2) queries within the domain."""
        sums = np.empty((len(queries), 3 * self._outputs, 1))
        for first in range(0, len(queries), QUERIES_AT_ONCE):
            part = slice(first, first + QUERIES_AT_ONCE)
            across, around = self._polynomials(queries[part])
            by_around = (across @ self._table).reshape(len(across), -1, self._around)
            np.matmul(by_around, around[:, :, None], out=sums[part])
        kinds = sums.reshape(-1, 3, self._outputs)
        return kinds[:, 0], np.swapaxes(kinds[:, 1:], 1, 2)

    def _polynomials(self, queries: Array) -> tuple[Array, Array]:
        """Values (m, p) of those of p_y and (m, q) of those of beta.

        cos(k t) is the real part of the k-th power of exp(i t), which costs no cosine.
        """
        unit = (queries - CENTRE) / COVERED
        powers = np.empty((max(self._across, self._around), *unit.shape), dtype=complex)
        powers[0] = 1.0
        powers[1:].real = unit
        powers[1:].imag = np.sqrt(1.0 - unit * unit)
        values = np.multiply.accumulate(powers, axis=0, out=powers).real
        return values[: self._across, :, 0].T, np.ascontiguousarray(values[: self._around, :, 1].T)


def added(first: Array, second: Array) -> Array:
    """Coefficients of the sum of functions (k, p, q) and as many others (k, r, s)."""
    total = np.zeros(np.maximum(first.shape, second.shape))
    for each in (first, second):
        total[:, : each.shape[1], : each.shape[2]] += each
    return total


def _with_slopes(coefficients: Array) -> Array:
    """(p, 3 k q) coefficients (k, p, q) of the values, then of the slopes by p_y and by beta."""
    slopes = np.zeros((2, *coefficients.shape))
    slopes[0, :, :-1] = chebder(coefficients, axis=1) / COVERED[0]
    slopes[1, :, :, :-1] = chebder(coefficients, axis=2) / COVERED[1]
    table = np.concatenate((coefficients[None], slopes))
    return np.moveaxis(table, 2, 0).reshape(coefficients.shape[1], -1)
