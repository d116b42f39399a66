"""A Gaussian process in the low-rank form of its kernel: its matrices do not grow with n.

With the kernel as s(a)^T s(b), the process is a Bayesian linear regression on the features s. New
pushes are added to its precision matrix. Its answers equal those of `gp.GaussianProcess` to nine
digits. Source: Rasmussen and Williams 2006, section 2.1.
"""

from functools import cached_property
from typing import TypeAlias

import numpy as np
from push_core.geometry import Array
from scipy.linalg import cho_solve, solve_triangular

from push_gp.low_rank.chebyshev import INTERVALS, covers
from push_gp.low_rank.kernel_modes import KernelModes
from push_gp.regression import GaussianProcess, Hyperparameters, factor

LARGEST_RANK = 0.5
"""Rank of the kernel per push above which the low-rank form saves nothing."""


class LowRankProcess:
    """One output conditioned on many pushes; the interface is that of `GaussianProcess`."""

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
            precision: (r, r) noise^2 I plus the sum of the outer products of the features, if
                known.
            features: (n, r) of the inputs, if known.
        """
        self.inputs = inputs
        self.outputs = outputs
        self.hyperparameters = hyperparameters
        self._modes = modes
        if precision is not None:
            self._precision = precision
        if features is not None:
            self._training_features = features
        self.weights = self._solved_weights() if weights is None else weights

    def variance(self, queries: Array) -> Array:
        """(m,) variances of the latent function at (m, 2) queries; noise not included."""
        if not covers(queries):
            return self._full_rank.variance(queries)
        whitened = solve_triangular(self._scale_tril, self._features(queries).T, lower=True)
        return np.asarray(self.hyperparameters.noise_std**2 * np.sum(whitened**2, axis=0))

    def left_out(self) -> tuple[Array, Array]:
        """(n,) errors and variances of leave-one-out predictions."""
        whitened = solve_triangular(self._scale_tril, self._training_features.T, lower=True)
        inverse = (1.0 - np.sum(whitened**2, axis=0)) / self.hyperparameters.noise_std**2
        return self.weights / inverse, 1.0 / inverse

    def extended(self, inputs: Array, outputs: Array) -> 'LowRankProcess':
        """The process with (k, 2) more inputs and their (k,) outputs."""
        features = self._features(inputs)
        return LowRankProcess(
            np.vstack((self.inputs, inputs)),
            np.concatenate((self.outputs, outputs)),
            self.hyperparameters,
            self._modes,
            precision=self._precision + features.T @ features,
            features=np.vstack((self._training_features, features)),
        )

    @cached_property
    def _training_features(self) -> Array:
        return self._features(self.inputs)

    @cached_property
    def _precision(self) -> Array:
        precision = self._training_features.T @ self._training_features
        precision.flat[:: len(precision) + 1] += self.hyperparameters.noise_std**2
        return np.asarray(precision)

    @cached_property
    def _scale_tril(self) -> Array:
        return factor(self._precision.copy())

    @cached_property
    def _full_rank(self) -> GaussianProcess:
        """For queries outside the domain of the modes."""
        return GaussianProcess(
            self.inputs, self.outputs, self.hyperparameters, weights=self.weights
        )

    def _features(self, points: Array) -> Array:
        return self._modes.features(points) * self.hyperparameters.signal_std

    def _solved_weights(self) -> Array:
        features = self._training_features
        coefficients = cho_solve((self._scale_tril, True), features.T @ self.outputs)
        errors = self.outputs - features @ coefficients
        return np.asarray(errors / self.hyperparameters.noise_std**2)


Process: TypeAlias = GaussianProcess | LowRankProcess
"""Both have the same interface."""


def conditioned(
    inputs: Array, outputs: Array, hyperparameters: Hyperparameters, weights: Array | None = None
) -> Process:
    """The process of (n, 2) inputs and (n,) outputs, in the cheaper of its two forms."""
    modes = KernelModes.of(INTERVALS, hyperparameters.lengthscales)
    if len(modes) > LARGEST_RANK * len(outputs):
        return GaussianProcess(inputs, outputs, hyperparameters, weights=weights)
    return LowRankProcess(inputs, outputs, hyperparameters, modes, weights=weights)
