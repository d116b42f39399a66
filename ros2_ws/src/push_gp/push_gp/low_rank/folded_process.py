"""A Gaussian process whose factor is as small as the kernel's rank, however many its pushes.

With the kernel as s(a)^T s(b), the process is a Bayesian linear regression on the features s; its
Cholesky factor takes new pushes in by summing them. It says what `gp.GaussianProcess` says, to
nine digits. Source: Rasmussen and Williams 2006, section 2.1.
"""

from functools import cached_property
from typing import TypeAlias

import numpy as np
from push_core.geometry import Array
from scipy.linalg import cho_solve, solve_triangular

from push_gp.low_rank.domain import INTERVALS, covers
from push_gp.low_rank.kernel_modes import KernelModes
from push_gp.regression import GaussianProcess, Hyperparameters, factor

WORTH_FOLDING = 0.5
"""Features for each push from which folding gains nothing."""


class FoldedProcess:
    """One output conditioned on many pushes; see `GaussianProcess` for what it is asked."""

    def __init__(
        self,
        inputs: Array,
        outputs: Array,
        hyperparameters: Hyperparameters,
        modes: KernelModes,
        *,
        weights: Array | None = None,
        precision: Array | None = None,
        features: Array | None = None,
    ) -> None:
        """Conditions on the pushes.

        Args:
            inputs: (n, 2).
            outputs: (n,).
            hyperparameters: of this output.
            modes: of its kernel.
            weights: (n,) if known.
            precision: (r, r) noise^2 + the sum of the outer products of the features, if known.
            features: (n, r) of the inputs, if known.
        """
        self.inputs = inputs
        self.outputs = outputs
        self.hyperparameters = hyperparameters
        self._modes = modes
        if precision is not None:
            self._precision = precision
        if features is not None:
            self._known = features
        self.weights = self._solved_weights() if weights is None else weights

    def variance(self, queries: Array) -> Array:
        """(m,) variances of the function, without a measurement's noise, at (m, 2) queries."""
        if not covers(queries):
            return self._unfolded.variance(queries)
        whitened = solve_triangular(self._scale_tril, self._features(queries).T, lower=True)
        return np.asarray(self.hyperparameters.noise_std**2 * np.sum(whitened**2, axis=0))

    def left_out(self) -> tuple[Array, Array]:
        """(n,) errors and variances of each push as the others predict it."""
        whitened = solve_triangular(self._scale_tril, self._known.T, lower=True)
        inverse = (1.0 - np.sum(whitened**2, axis=0)) / self.hyperparameters.noise_std**2
        return self.weights / inverse, 1.0 / inverse

    def extended(self, inputs: Array, outputs: Array) -> 'FoldedProcess':
        """Conditioned on (k, 2) further inputs and their (k,) outputs."""
        features = self._features(inputs)
        return FoldedProcess(
            np.vstack((self.inputs, inputs)),
            np.concatenate((self.outputs, outputs)),
            self.hyperparameters,
            self._modes,
            precision=self._precision + features.T @ features,
            features=np.vstack((self._known, features)),
        )

    @cached_property
    def _known(self) -> Array:
        return self._features(self.inputs)

    @cached_property
    def _precision(self) -> Array:
        precision = self._known.T @ self._known
        precision.flat[:: len(precision) + 1] += self.hyperparameters.noise_std**2
        return np.asarray(precision)

    @cached_property
    def _scale_tril(self) -> Array:
        return factor(self._precision.copy())

    @cached_property
    def _unfolded(self) -> GaussianProcess:
        """For queries off the domain."""
        return GaussianProcess(
            self.inputs, self.outputs, self.hyperparameters, weights=self.weights
        )

    def _features(self, points: Array) -> Array:
        return self._modes.features(points) * self.hyperparameters.signal_std

    def _solved_weights(self) -> Array:
        coefficients = cho_solve((self._scale_tril, True), self._known.T @ self.outputs)
        left = self.outputs - self._known @ coefficients
        return np.asarray(left / self.hyperparameters.noise_std**2)


Process: TypeAlias = GaussianProcess | FoldedProcess
"""Both are asked the same."""


def conditioned(
    inputs: Array, outputs: Array, hyperparameters: Hyperparameters, weights: Array | None = None
) -> Process:
    """The process of (n, 2) inputs and (n,) outputs, in the form that is cheaper."""
    modes = KernelModes.of(INTERVALS, hyperparameters.lengthscales)
    if len(modes) > WORTH_FOLDING * len(outputs):
        return GaussianProcess(inputs, outputs, hyperparameters, weights=weights)
    return FoldedProcess(inputs, outputs, hyperparameters, modes, weights=weights)
