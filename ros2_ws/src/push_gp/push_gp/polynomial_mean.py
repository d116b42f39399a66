"""Means and Jacobians at a cost that hardly depends on the number of pushes.

The mean is as smooth as its kernel, and the kernel is a product of functions of one input each.
So the pushes are summed once into Chebyshev polynomials of p_y and beta, exact to round-off within
the domain; an answer is then two matrix products, without a single exponential.
"""

from collections.abc import Sequence

import numpy as np
from numpy.polynomial.chebyshev import chebder
from push_core.frames import Array

from push_gp.chebyshev import Interval
from push_gp.domain import CENTRE, COVERED, INTERVALS
from push_gp.folded_process import Process

CUT_OFF = 1e-12
"""What the polynomials that are left out amount to, of the root mean square of a mean."""

QUERIES_AT_ONCE = 1024
"""So few that what is worked on stays in the cache of one core."""


class PolynomialMean:
    """The posterior mean of k processes that share their inputs, as polynomials."""

    def __init__(self, processes: Sequence[Process]) -> None:
        """Sums their pushes up."""
        lengthscales = np.array([gp.hyperparameters.lengthscales for gp in processes])
        counts = [
            interval.enough(lengthscale)
            for interval, lengthscale in zip(INTERVALS, lengthscales.min(axis=0), strict=True)
        ]
        coefficients = _trimmed(np.stack([_coefficients(gp, counts) for gp in processes]))
        self._outputs, self._across, self._around = coefficients.shape
        self._table = _with_slopes(coefficients)

    @property
    def size(self) -> int:
        """Polynomials in both inputs, to which the cost of an answer is proportional."""
        return int(self._across * self._around)

    def evaluate(self, queries: Array) -> tuple[Array, Array]:
        """Mean (m, k) and Jacobian (m, k, 2) at (m, 2) queries within the domain."""
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


def _coefficients(process: Process, counts: Sequence[int]) -> Array:
    """(p, q) of one mean: the sum over its pushes of products of two kernels in one input."""
    across, around = (
        _kernel_to(points, lengthscale, interval, count)
        for points, lengthscale, interval, count in zip(
            process.inputs.T, process.hyperparameters.lengthscales, INTERVALS, counts, strict=True
        )
    )
    weights = process.weights * process.hyperparameters.signal_std**2
    return np.asarray((across * weights) @ around.T)


def _kernel_to(points: Array, lengthscale: float, interval: Interval, count: int) -> Array:
    """(count, n) coefficients of the kernels to points (n,) in one input."""
    differences = interval.nodes(count)[:, None] - points
    return np.asarray(interval.transform(count) @ np.exp(-((differences / lengthscale) ** 2)))


def _trimmed(coefficients: Array) -> Array:
    """(k, p, q) without the highest polynomials of each input, where no mean needs them."""
    sizes = np.linalg.norm(coefficients, axis=(1, 2), keepdims=True)
    shares = np.abs(coefficients) / np.maximum(sizes, np.finfo(float).tiny)
    across, around = _needed(shares.sum(axis=2)), _needed(shares.sum(axis=1))
    return coefficients[:, :across, :around]


def _needed(shares: Array) -> int:
    """How many of (k, p) leave out no more than the cut-off; at least two."""
    left = np.cumsum(shares[:, ::-1], axis=1)[:, ::-1].max(axis=0)
    return max(2, int(np.count_nonzero(left > CUT_OFF)))


def _with_slopes(coefficients: Array) -> Array:
    """(p, 3 k q) coefficients (k, p, q) of the means, then of their slopes by p_y and by beta."""
    slopes = np.zeros((2, *coefficients.shape))
    slopes[0, :, :-1] = chebder(coefficients, axis=1) / COVERED[0]
    slopes[1, :, :, :-1] = chebder(coefficients, axis=2) / COVERED[1]
    table = np.concatenate((coefficients[None], slopes))
    return np.moveaxis(table, 2, 0).reshape(coefficients.shape[1], -1)
