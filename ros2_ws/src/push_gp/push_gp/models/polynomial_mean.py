"""The posterior mean summed up, so that its cost hardly depends on the number of pushes.

The mean is as smooth as its kernel, and the kernel is a product of functions of one input each.
So the pushes are summed once into Chebyshev polynomials of p_y and beta, exact to round-off within
the domain.
"""

from collections.abc import Sequence

import numpy as np
from push_core.geometry import Array

from push_gp.low_rank import INTERVALS, Interval, Process

CUT_OFF = 1e-12
"""What the polynomials that are left out amount to, of the root mean square of a mean."""


def summed_up(processes: Sequence[Process]) -> Array:
    """Coefficients (k, p, q) of the means of k processes, each summed over its pushes."""
    lengthscales = np.array([gp.hyperparameters.lengthscales for gp in processes])
    counts = [
        interval.enough(lengthscale)
        for interval, lengthscale in zip(INTERVALS, lengthscales.min(axis=0), strict=True)
    ]
    return _trimmed(np.stack([_coefficients(gp, counts) for gp in processes]))


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
