"""Exact Gaussian process regression of one output with zero mean.

Source: Rasmussen and Williams 2006, algorithm 2.1.
"""

from functools import cached_property

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from scipy.linalg import LinAlgError, cholesky, solve_triangular

from push_gp.regression.kernel import (
    Hyperparameters,
    correlation,
    cross_covariance,
    squared_differences,
)

ROWS_AT_ONCE = 256


class GaussianProcess:
    """One output conditioned on pushes.

    Attributes:
        inputs: (n, 2) contact offsets [m] and directions [rad].
        outputs: (n,) displacements of one kind [m or rad].
        hyperparameters: in the same units.
        weights: (n,) inverse covariance times outputs.
    """

    def __init__(
        self,
        inputs: Array,
        outputs: Array,
        hyperparameters: Hyperparameters,
        *,
        weights: Array | None = None,
        scale_tril: Array | None = None,
    ) -> None:
        """Conditions on the pushes.

        Args:
            inputs: (n, 2).
            outputs: (n,).
            hyperparameters: of this output.
            weights: (n,) if known; the mean then needs no Cholesky factor.
            scale_tril: (n, n) Cholesky factor of the covariance, if known.
        """
        self.inputs = inputs
        self.outputs = outputs
        self.hyperparameters = hyperparameters
        if scale_tril is not None:
            self.scale_tril = scale_tril
        self.weights = self._solved_weights() if weights is None else weights

    @cached_property
    def scale_tril(self) -> Array:
        """(n, n) lower Cholesky factor of the covariance of the measurements."""
        differences = squared_differences(self.inputs)
        covariance = correlation(differences, self.hyperparameters.lengthscales)
        covariance *= self.hyperparameters.signal_std**2
        covariance.flat[:: len(covariance) + 1] += self.hyperparameters.noise_std**2
        return factor(covariance)

    def mean(self, queries: Array) -> Array:
        """(m,) expected outputs at (m, 2) queries."""
        return cross_covariance(queries, self.inputs, self.hyperparameters) @ self.weights

    def variance(self, queries: Array) -> Array:
        """(m,) variances of the latent function at (m, 2) queries; noise not included."""
        result = np.empty(len(queries))
        for first in range(0, len(queries), ROWS_AT_ONCE):
            rows = slice(first, first + ROWS_AT_ONCE)
            covariance = cross_covariance(queries[rows], self.inputs, self.hyperparameters)
            whitened = solve_triangular(self.scale_tril, covariance.T, lower=True)
            result[rows] = self.hyperparameters.signal_std**2 - np.sum(whitened**2, axis=0)
        # near the training pushes the difference is round-off, which may be negative
        return np.maximum(result, 0.0, out=result)

    def left_out(self) -> tuple[Array, Array]:
        """(n,) errors and variances of leave-one-out predictions.

        Source: Rasmussen and Williams 2006, equations 5.10 and 5.11.
        """
        inverse_tril = solve_triangular(self.scale_tril, np.eye(len(self.outputs)), lower=True)
        inverse = np.sum(inverse_tril**2, axis=0)
        return self.weights / inverse, 1.0 / inverse

    def extended(self, inputs: Array, outputs: Array) -> 'GaussianProcess':
        """The process with k more pushes at the same hyperparameters, in O(n^2 k).

        Args:
            inputs: (k, 2).
            outputs: (k,).
        """
        added = GaussianProcess(inputs, outputs, self.hyperparameters, weights=outputs)
        cross = cross_covariance(inputs, self.inputs, self.hyperparameters)
        whitened = solve_triangular(self.scale_tril, cross.T, lower=True)
        corner = added.scale_tril @ added.scale_tril.T - whitened.T @ whitened
        n, total = len(self.outputs), len(self.outputs) + len(outputs)
        scale_tril = np.zeros((total, total), order='F')
        scale_tril[:n, :n] = self.scale_tril
        scale_tril[n:, :n] = whitened.T
        scale_tril[n:, n:] = factor(corner)
        return GaussianProcess(
            np.vstack((self.inputs, inputs)),
            np.concatenate((self.outputs, outputs)),
            self.hyperparameters,
            scale_tril=scale_tril,
        )

    def _solved_weights(self) -> Array:
        whitened = solve_triangular(self.scale_tril, self.outputs, lower=True)
        return np.asarray(solve_triangular(self.scale_tril, whitened, lower=True, trans='T'))


def factor(covariance: Array) -> Array:
    """Lower Cholesky factor (n, n) of a covariance, which is overwritten.

    Raises:
        RunError: it is singular in double precision.
    """
    try:
        # the transpose of a symmetric matrix has the memory order of LAPACK
        factor = cholesky(covariance.T, lower=True, overwrite_a=True, check_finite=False)
    except LinAlgError:
        raise RunError('the covariance of the pushes is singular: are rows repeated?') from None
    return np.asarray(factor)
