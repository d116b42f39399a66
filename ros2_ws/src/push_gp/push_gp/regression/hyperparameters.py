"""What one Gaussian process is told beside its data: lengthscales, signal and noise."""

from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array


@dataclass(frozen=True)
class Hyperparameters:
    """Of the kernel signal_std^2 exp(-sum_j (x_j - x'_j)^2 / lengthscales_j^2), without a half.

    Attributes:
        lengthscales: one for each input, in the inputs' units.
        signal_std: sigma_f, in the output's unit.
        noise_std: standard deviation of a measurement about the function, in the output's unit.

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
