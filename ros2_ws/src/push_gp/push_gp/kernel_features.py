"""The squared exponential kernel as a product of features, in one dimension.

exp(-(a - b)^2) = sum_p f_p(a) f_p(b) with f_p(a) = exp(-a^2) sqrt(2^p / p!) a^p. The squares of
the features of any point sum to one, so the sum is well conditioned; where |a|, |b| <= A, what is
cut off after P terms is at most the chance of P or more events of a Poisson law of mean 2 A^2.
Source: the Taylor features of Cotter, Keshet and Srebro 2011, arXiv:1109.4603.
"""

import numpy as np
from push_core.frames import Array
from scipy.special import pdtrc

CUT_OFF = 1e-16
"""Largest error of a covariance of unit signal."""

MOST_FEATURES = 300


def enough_features(reach: float) -> int:
    """How many features give the kernel to round-off where |a| <= `reach` lengthscales.

    One more than `MOST_FEATURES` where so many are not enough.
    """
    counts = np.arange(2, MOST_FEATURES + 1)
    remainder = pdtrc(counts - 1, 2.0 * reach**2)
    return 2 + int(np.count_nonzero(remainder > CUT_OFF))


def features(a: Array, count: int) -> Array:
    """Features (count, ...) of points (...) in lengthscales."""
    steps = np.empty((count, *a.shape))
    np.exp(-a * a, out=steps[0])
    np.multiply.outer(_ratios(count), a, out=steps[1:])
    return np.multiply.accumulate(steps, axis=0, out=steps)


def feature_slopes(a: Array, values: Array) -> Array:
    """Derivatives (p, ...) by their point of the features (p, ...) of points (...)."""
    slopes: Array = values * (-2.0 * a)
    powers = 2.0 / _ratios(len(values))
    slopes[1:] += values[:-1] * powers.reshape(-1, *(1,) * a.ndim)
    return slopes


def _ratios(count: int) -> Array:
    """(count - 1,) factors sqrt(2 / p), which times a lead from each feature to the next."""
    return np.sqrt(2.0 / np.arange(1, count))
