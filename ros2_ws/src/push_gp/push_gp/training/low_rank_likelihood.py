"""Log marginal likelihood with its gradient in low-rank form: the cost does not grow with n.

In a basis of polynomials the kernel is Phi C Phi^T: the pushes enter only through Phi^T Phi and
Phi^T y, which are computed once. With C = S S^T everything follows from the matrix
B = noise^2 + S^T Phi^T Phi S, whose size is the rank of the kernel (Rasmussen and Williams 2006,
section 8.1 and appendix A.3). The result differs from that of `MarginalLikelihood` by less than
1e-3 nat.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from scipy.linalg import lapack

from push_gp.low_rank import Interval, KernelModes
from push_gp.regression import Hyperparameters, MarginalLikelihood

CUT_OFF = 1e-12
"""Smallest term of the kernel of unit signal that is kept. Smaller ones change the likelihood of
thousands of pushes by less than 1e-3 nat and would make the matrices a third larger."""

MARGIN = 0.85
"""A basis is made for lengthscales shorter by this factor, so that it can be reused while the
optimiser shortens them."""

LARGEST_RANK = 0.8
"""Rank of the kernel per push above which the full covariance is faster."""


@dataclass(frozen=True)
class Sums:
    """Sums over the pushes from which the likelihood is computed.

    Attributes:
        shortest: (2,) lengthscales [m, rad] down to which the sums are valid.
        modes: of the kernel at the shortest lengthscales.
        gram: (M, M) Phi^T Phi, Phi the products of the modes at the pushes.
        moments: (M,) Phi^T y.
    """

    shortest: Array
    modes: KernelModes
    gram: Array
    moments: Array


class LowRankLikelihood:
    """Of (n,) outputs at (n, 2) inputs, as a function of the hyperparameters."""

    def __init__(self, inputs: Array, outputs: Array) -> None:
        self._inputs, self._outputs = inputs, outputs
        self._squared = float(outputs @ outputs)
        self._intervals = tuple(Interval.around(column) for column in inputs.T)
        self._sums: Sums | None = None

    def with_gradient(self, hyperparameters: Hyperparameters) -> tuple[float, Array]:
        """See `MarginalLikelihood.with_gradient`."""
        sums = self._sums_for(np.array(hyperparameters.lengthscales))
        if sums is None:
            return self._full_rank.with_gradient(hyperparameters)
        factors = [
            _Factor.of(*(modes.T @ part @ modes for part in interval.kernel(length, len(modes))))
            for interval, length, modes in zip(
                self._intervals, hyperparameters.lengthscales, sums.modes.modes, strict=True
            )
        ]
        return self._from_factors(sums, factors, hyperparameters)

    @cached_property
    def _full_rank(self) -> MarginalLikelihood:
        """For lengthscales that are too short for the low-rank form."""
        return MarginalLikelihood(self._inputs, self._outputs)

    def _sums_for(self, lengthscales: Array) -> Sums | None:
        """Valid sums; None if the rank is about the number of pushes."""
        if self._sums is None or (lengthscales < self._sums.shortest).any():
            modes = KernelModes.of(self._intervals, (MARGIN * lengthscales).tolist(), CUT_OFF)
            if len(modes) > LARGEST_RANK * len(self._outputs):
                return None
            phi = modes.products_at(self._inputs)
            self._sums = Sums(MARGIN * lengthscales, modes, phi.T @ phi, phi.T @ self._outputs)
        return self._sums

    def _from_factors(
        self, sums: Sums, factors: list['_Factor'], hyperparameters: Hyperparameters
    ) -> tuple[float, Array]:
        across, around = factors
        kept = np.array(np.nonzero(np.outer(across.values, around.values) > CUT_OFF))
        first, second = sums.modes.products
        scale = across.scaled[first][:, kept[0]]
        scale *= around.scaled[second][:, kept[1]]
        scale *= hyperparameters.signal_std
        projected = scale.T @ sums.gram @ scale
        moments = scale.T @ sums.moments
        noise = hyperparameters.noise_std**2
        inverse, log_determinant = _inverted(projected, noise)
        theta = inverse @ moments
        count = len(self._outputs)
        explained = (self._squared - moments @ theta) / noise
        log_determinant += (count - len(theta)) * math.log(noise)
        value = -0.5 * (explained + log_determinant + count * math.log(2.0 * math.pi))
        # theta theta^T - S^T Phi^T K^-1 Phi S
        left = np.outer(theta, theta)
        left += noise * inverse
        left.flat[:: len(theta) + 1] -= 1.0
        by_signal = float(np.trace(left))
        squared_weights = (explained - theta @ theta) / noise
        by_noise = noise * squared_weights - count + len(theta) - noise * np.trace(inverse)
        lengths = [
            0.5 * np.sum(factor.slopes[np.ix_(mine, mine)] * left, where=other[:, None] == other)
            for factor, mine, other in zip(factors, kept, kept[::-1], strict=True)
        ]
        return value, np.array([*lengths, by_signal, by_noise])


@dataclass(frozen=True)
class _Factor:
    """Square root of the kernel of one input, and the derivative of the kernel in its basis.

    Attributes:
        values: (r,) eigenvalues above `CUT_OFF`.
        scaled: (m, r) eigenvectors times the roots of the eigenvalues.
        slopes: (r, r) X with d kernel / d log l = scaled X scaled^T.
    """

    values: Array
    scaled: Array
    slopes: Array

    @classmethod
    def of(cls, kernel: Array, slope: Array) -> '_Factor':
        """From coefficients (m, m) of the kernel and of its derivative."""
        values, vectors = np.linalg.eigh(kernel)
        kept = values > CUT_OFF
        values, vectors = values[kept], vectors[:, kept]
        roots = np.sqrt(values)
        slopes = (vectors.T @ slope @ vectors) / np.outer(roots, roots)
        return cls(values, vectors * roots, slopes)


def _inverted(projected: Array, noise: float) -> tuple[Array, float]:
    """Inverse of projected + noise, and the logarithm of its determinant."""
    projected.flat[:: len(projected) + 1] += noise
    triangle, failed = lapack.dpotrf(projected.T, lower=1, clean=1, overwrite_a=1)
    if failed:
        raise RunError('the covariance of the pushes is singular')
    log_determinant = 2.0 * float(np.log(np.diagonal(triangle)).sum())
    half, _ = lapack.dpotri(triangle, lower=1, overwrite_c=1)
    inverse = half + half.T
    inverse.flat[:: len(inverse) + 1] *= 0.5
    return inverse, log_determinant
