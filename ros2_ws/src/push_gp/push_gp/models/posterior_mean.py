"""Posterior means of several Gaussian processes with the same inputs, and their Jacobians."""

from collections.abc import Sequence

import numpy as np
from push_core.geometry import Array

from push_gp.low_rank import Process
from push_gp.regression import input_features, query_features

CACHED_NUMBERS = 100_000
"""Covariances per batch: as many as fit in the cache of one core."""


class PosteriorMean:
    """Mean and Jacobian of k processes, with everything precomputed that no query changes.

    With b = x / l, the mean is sum_i k_i w_i and its slope by input j is
    -2 / l_j (a_j sum_i k_i w_i - sum_i k_i w_i b_ij), so one product of the covariances with
    [w, w b_1, w b_2] yields both.
    """

    def __init__(self, processes: Sequence[Process]) -> None:
        """Takes k processes that share their n inputs."""
        scaled = [gp.inputs / gp.hyperparameters.lengthscales for gp in processes]
        weights = [gp.weights * gp.hyperparameters.signal_std**2 for gp in processes]
        self._lengthscales = np.array([[gp.hyperparameters.lengthscales] for gp in processes])
        self._features = np.ascontiguousarray(np.swapaxes(input_features(np.stack(scaled)), 1, 2))
        self._moments = np.stack(
            [
                np.column_stack((w, w * b[:, 0], w * b[:, 1]))
                for w, b in zip(weights, scaled, strict=True)
            ]
        )

    def evaluate(self, queries: Array) -> tuple[Array, Array]:
        """Mean (m, k) and Jacobian (m, k, 2) at (m, 2) queries."""
        a = queries / self._lengthscales
        features = query_features(a)
        sums = np.empty((len(a), len(queries), 3))
        rows = max(1, CACHED_NUMBERS // self._moments.shape[1])
        for first in range(0, len(queries), rows):
            part = slice(first, first + rows)
            exponent = features[:, part] @ self._features
            np.matmul(np.exp(exponent, out=exponent), self._moments, out=sums[:, part])
        slopes = (a * sums[..., :1] - sums[..., 1:]) * (-2.0 / self._lengthscales)
        return sums[..., 0].T, np.swapaxes(slopes, 0, 1)
