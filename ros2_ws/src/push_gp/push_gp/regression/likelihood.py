"""Log marginal likelihood of one output, with its gradient.

Source: Rasmussen and Williams 2006, equations 2.30 and 5.9, for the kernel of `kernel`.
"""

import math

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from scipy.linalg import lapack

from push_gp.regression.kernel import Hyperparameters, correlation, squared_differences


class MarginalLikelihood:
    """Of (n,) outputs at (n, 2) inputs, as a function of the hyperparameters."""

    def __init__(self, inputs: Array, outputs: Array) -> None:
        self._differences = squared_differences(inputs)
        self._outputs = outputs
        # allocating matrices of this size takes longer than the arithmetic on them
        self._signal, self._work = np.empty((2, len(outputs), len(outputs)))

    def with_gradient(self, hyperparameters: Hyperparameters) -> tuple[float, Array]:
        """The logarithm [nat] and its gradient (4,) by the logarithms of the hyperparameters.

        Raises:
            RunError: the covariance is singular in double precision.
        """
        correlation(self._differences, hyperparameters.lengthscales, self._signal)
        self._signal *= hyperparameters.signal_std**2
        triangle = self._factor(hyperparameters.noise_std)
        weights, _ = lapack.dpotrs(triangle, self._outputs, lower=1)
        value = self._value(triangle, weights)
        inverse, _ = lapack.dpotri(triangle, lower=1, overwrite_c=1)
        return value, self._gradient(inverse.T, weights, hyperparameters)

    def _factor(self, noise_std: float) -> Array:
        np.copyto(self._work, self._signal)
        self._work.flat[:: len(self._outputs) + 1] += noise_std**2
        # the transpose of a symmetric matrix has the memory order of LAPACK
        triangle, failed = lapack.dpotrf(self._work.T, lower=1, clean=1, overwrite_a=1)
        if failed:
            raise RunError('the covariance of the pushes is singular')
        return np.asarray(triangle)

    def _value(self, triangle: Array, weights: Array) -> float:
        log_determinant = 2.0 * np.log(np.diagonal(triangle)).sum()
        constant = len(self._outputs) * math.log(2.0 * math.pi)
        return float(-0.5 * (self._outputs @ weights + log_determinant + constant))

    def _gradient(self, inverse: Array, weights: Array, hyperparameters: Hyperparameters) -> Array:
        """From w w^T - K^-1; `inverse` holds a triangle of K^-1 and zeros, and is overwritten."""
        noise = hyperparameters.noise_std**2
        squared_weights, trace = weights @ weights, np.trace(inverse)
        explained = self._outputs @ weights - noise * squared_weights
        by_signal = explained - len(self._outputs) + noise * trace
        by_lengthscales = self._by_lengthscales(inverse, weights, hyperparameters)
        return np.array([*by_lengthscales, by_signal, noise * (squared_weights - trace)])

    def _by_lengthscales(
        self, inverse: Array, weights: Array, hyperparameters: Hyperparameters
    ) -> Array:
        # the differences are zero on the diagonal, so one triangle is doubled
        difference = inverse
        difference *= -2.0
        difference += weights[:, None] * weights
        difference *= self._signal
        products = [np.vdot(difference, each) for each in self._differences]
        return np.array(products) / np.square(hyperparameters.lengthscales)
