"""Log marginal likelihood of one output, with its gradient.

Source: Rasmussen and Williams 2006, equations 2.30 and 5.9, for the kernel of `kernel`.
"""

import math

import numpy as np
from push_core.errors import RunError
from push_core.frames import Array
from scipy.linalg import lapack

from push_gp.hyperparameters import Hyperparameters
from push_gp.kernel import correlation, squared_differences


class MarginalLikelihood:
    """Of (n,) outputs over (n, 2) inputs, as a function of the hyperparameters."""

    def __init__(self, inputs: Array, outputs: Array) -> None:
        self._differences = squared_differences(inputs)
        self._outputs = outputs

    def with_gradient(self, hyperparameters: Hyperparameters) -> tuple[float, Array]:
        """The logarithm [nat] and its gradient (4,) by the logarithms of the hyperparameters.

        Raises:
            RunError: the covariance is singular in double precision.
        """
        signal = correlation(self._differences, hyperparameters.lengthscales)
        signal *= hyperparameters.signal_std**2
        triangle = self._factor(signal, hyperparameters.noise_std)
        weights, _ = lapack.dpotrs(triangle, self._outputs, lower=1)
        value = self._value(triangle, weights)
        inverse, _ = lapack.dpotri(triangle, lower=1, overwrite_c=1)
        return value, self._gradient(signal, inverse.T, weights, hyperparameters)

    def _factor(self, signal: Array, noise_std: float) -> Array:
        covariance = signal.copy()
        covariance.flat[:: len(signal) + 1] += noise_std**2
        # a symmetric matrix is its own transpose, which is in the order that LAPACK works on
        triangle, failed = lapack.dpotrf(covariance.T, lower=1, clean=1, overwrite_a=1)
        if failed:
            raise RunError('the covariance of the pushes is singular')
        return np.asarray(triangle)

    def _value(self, triangle: Array, weights: Array) -> float:
        log_determinant = 2.0 * np.log(np.diagonal(triangle)).sum()
        constant = len(weights) * math.log(2.0 * math.pi)
        return float(-0.5 * (self._outputs @ weights + log_determinant + constant))

    def _gradient(
        self, signal: Array, inverse: Array, weights: Array, hyperparameters: Hyperparameters
    ) -> Array:
        """From W = w w^T - K^-1; `inverse` holds one triangle of K^-1 and zeros."""
        count = len(weights)
        noise = hyperparameters.noise_std**2
        squared_weights, trace = weights @ weights, np.trace(inverse)
        by_signal = self._outputs @ weights - noise * squared_weights - count + noise * trace
        by_lengthscales = []
        for differences, lengthscale in zip(
            self._differences, hyperparameters.lengthscales, strict=True
        ):
            slope = signal * differences
            # the diagonal of `slope` is zero, so the other triangle counts by doubling
            product = weights @ slope @ weights - 2.0 * np.vdot(inverse, slope)
            by_lengthscales.append(product / lengthscale**2)
        return np.array([*by_lengthscales, by_signal, noise * (squared_weights - trace)])
