"""The squared exponential kernel of the paper, exp(-sum_j (x_j - x'_j)^2 / l_j^2), with ARD.

There is no 1/2 in the exponent: a lengthscale here is sqrt(2) times that of most libraries.
"""

from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array


@dataclass(frozen=True)
class Hyperparameters:
    """Of the kernel signal_std^2 exp(-sum_j (x_j - x'_j)^2 / lengthscales_j^2) plus noise.

    Attributes:
        lengthscales: one for each input, in the inputs' units.
        signal_std: sigma_f, in the output's unit.
        noise_std: standard deviation of the measurement noise, in the output's unit.

    Raises:
        InputError: a value is not finite and positive.
    """

    lengthscales: tuple[float, float]
    signal_std: float
    noise_std: float

    def __post_init__(self) -> None:
        values = np.array([*self.lengthscales, self.signal_std, self.noise_std])
        if values.shape != (4,) or not (np.isfinite(values).all() and (values > 0).all()):
            raise InputError(f'hyperparameters must be positive numbers, not {values.tolist()}')

    def as_logarithms(self) -> Array:
        """(4,) natural logarithms: lengthscales, signal_std, noise_std."""
        return np.log([*self.lengthscales, self.signal_std, self.noise_std])

    @classmethod
    def from_logarithms(cls, logarithms: Array) -> 'Hyperparameters':
        """The inverse of `as_logarithms`."""
        first, second, signal, noise = np.exp(logarithms).tolist()
        return cls((first, second), signal, noise)


def squared_differences(inputs: Array) -> Array:
    """(2, n, n) squared differences within (n, 2) inputs; exact zeros on the diagonal."""
    differences = inputs.T[:, :, None] - inputs.T[:, None, :]
    differences *= differences
    return differences


def correlation(
    differences: Array, lengthscales: tuple[float, float], out: Array | None = None
) -> Array:
    """(n, n) kernel of unit signal for `squared_differences` (2, n, n), into `out` if given."""
    first, second = (-1.0 / lengthscale**2 for lengthscale in lengthscales)
    exponent: Array = np.multiply(differences[0], first, out=out)
    exponent += differences[1] * second
    np.exp(exponent, out=exponent)
    return exponent


def cross_covariance(queries: Array, inputs: Array, hyperparameters: Hyperparameters) -> Array:
    """(m, n) covariances between (m, 2) queries and (n, 2) inputs."""
    a, b = (points / hyperparameters.lengthscales for points in (queries, inputs))
    covariance: Array = query_features(a) @ input_features(b).T
    np.exp(covariance, out=covariance)
    covariance *= hyperparameters.signal_std**2
    return covariance


def query_features(a: Array) -> Array:
    """(..., m, 4) features whose product with `input_features` is the exponent -|a - b|^2.

    One matrix product is many times faster than differences. It is exact to a few units in the
    last place, because the inputs span only a few lengthscales.

    Args:
        a: (..., m, 2) queries divided by the lengthscales.
    """
    features = np.empty((*a.shape[:-1], 4))
    features[..., :2] = 2.0 * a
    features[..., 2] = -np.sum(a * a, axis=-1)
    features[..., 3] = 1.0
    return features


def input_features(b: Array) -> Array:
    """(..., n, 4) counterpart of `query_features` for inputs divided by the lengthscales."""
    features = np.empty((*b.shape[:-1], 4))
    features[..., :2] = b
    features[..., 2] = 1.0
    features[..., 3] = -np.sum(b * b, axis=-1)
    return features
