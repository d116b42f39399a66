"""The learned model: a mean function, and one Gaussian process per output for the residuals."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from push_core.data import PushSet
from push_core.geometry import Array

from push_gp.low_rank import Process, conditioned
from push_gp.models.mean_function import ConeMean, MeanFunction
from push_gp.models.model import ModelInfo
from push_gp.models.posterior_mean import PosteriorMean
from push_gp.models.sampling import spread_rows
from push_gp.regression import Hyperparameters

NORMAL_95 = 1.959963984540054
"""95 % of a normal distribution lie within so many standard deviations of its mean."""

NORMAL_PRIOR = 200
"""Number of pushes that outweigh the assumption of normally distributed errors."""


@dataclass(frozen=True)
class GpModel:
    """Three Gaussian processes conditioned on one push set.

    Attributes:
        pushes: the training set.
        mean_function: what they predict far from all pushes.
        processes: for dx [m], dy [m] and dtheta [rad].
    """

    pushes: PushSet
    mean_function: MeanFunction
    processes: tuple[Process, ...]

    @classmethod
    def conditioned(
        cls,
        pushes: PushSet,
        mean_function: MeanFunction,
        hyperparameters: Sequence[Hyperparameters],
        weights: Array | None = None,
    ) -> 'GpModel':
        """The model of a push set at given hyperparameters.

        Args:
            pushes: the training set, n pushes.
            mean_function: of the same distance.
            hyperparameters: of dx, dy and dtheta.
            weights: (3, n) if known.
        """
        outputs = residuals(pushes, mean_function)
        known = [None] * 3 if weights is None else list(weights)
        processes = [
            conditioned(pushes.inputs, *of_output)
            for of_output in zip(outputs, hyperparameters, known, strict=True)
        ]
        return cls(pushes, mean_function, tuple(processes))

    @property
    def distance(self) -> float:
        """See `PushModel.distance`."""
        return self.pushes.distance

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`."""
        prior, prior_jacobian = self.mean_function.evaluate(p_y, beta)
        mean, jacobian = self._posterior_mean.evaluate(np.column_stack((p_y, beta)))
        return prior + mean, prior_jacobian + jacobian

    def variance(self, p_y: Array, beta: Array) -> Array:
        """See `PushModel.variance`."""
        queries = np.column_stack((p_y, beta))
        return np.column_stack([process.variance(queries) for process in self.processes])

    @property
    def noise_variance(self) -> Array:
        """(3,) variances of the measurement noise [m^2, m^2, rad^2]."""
        return np.array([process.hyperparameters.noise_std**2 for process in self.processes])

    @cached_property
    def interval_95(self) -> Array:
        """(3,) half width of the 95 % interval of a measurement, in standard deviations.

        The errors of real pushes have heavier tails than a normal distribution. The half width is
        the 95 % quantile of the leave-one-out errors of the training pushes, drawn towards the
        normal value if there are few.
        """
        trust = len(self.pushes) / (len(self.pushes) + NORMAL_PRIOR)
        errors = [process.left_out() for process in self.processes]
        quantiles = [
            np.quantile(np.abs(error) / np.sqrt(spread), 0.95) for error, spread in errors
        ]
        return NORMAL_95 + trust * (np.array(quantiles) - NORMAL_95)

    def extended(self, pushes: PushSet) -> 'GpModel':
        """The model with more pushes at the same hyperparameters.

        Raises:
            InputError: the pushes cover another distance.
        """
        joined = self.pushes.joined(pushes)
        added = residuals(pushes, self.mean_function)
        processes = [
            process.extended(pushes.inputs, outputs)
            for process, outputs in zip(self.processes, added, strict=True)
        ]
        return GpModel(joined, self.mean_function, tuple(processes))

    def thinned(self, most: int) -> 'GpModel':
        """The model of at most `most` of its pushes, at the same hyperparameters."""
        if len(self.pushes) <= most:
            return self
        pushes = self.pushes.take(spread_rows(self.pushes.inputs, most))
        hyperparameters = [process.hyperparameters for process in self.processes]
        return GpModel.conditioned(pushes, self.mean_function, hyperparameters)

    @cached_property
    def info(self) -> ModelInfo:
        """See `PushModel.info`."""
        hyperparameters = [process.hyperparameters for process in self.processes]
        return ModelInfo(
            model_hash=self._hash(),
            kind='gp',
            mean_function=mean_function_name(self.mean_function),
            points=len(self.pushes),
            training_set_hash=self.pushes.sha256(),
            distance=self.distance,
            p_y_domain=(float(self.pushes.p_y.min()), float(self.pushes.p_y.max())),
            beta_domain=(float(self.pushes.beta.min()), float(self.pushes.beta.max())),
            lengthscales=np.array([each.lengthscales for each in hyperparameters]),
            signal_std=np.array([each.signal_std for each in hyperparameters]),
            noise_std=np.array([each.noise_std for each in hyperparameters]),
        )

    @cached_property
    def _posterior_mean(self) -> PosteriorMean:
        return PosteriorMean(self.processes)

    def _hash(self) -> str:
        digest = hashlib.sha256(self.pushes.sha256().encode())
        if isinstance(self.mean_function, ConeMean):
            digest.update(self.mean_function.cone.info.model_hash.encode())
        for process in self.processes:
            hyperparameters = process.hyperparameters
            numbers = [
                *hyperparameters.lengthscales,
                hyperparameters.signal_std,
                hyperparameters.noise_std,
            ]
            digest.update(np.array(numbers, '<f8').tobytes())
            digest.update(np.ascontiguousarray(process.weights, '<f8').tobytes())
        return digest.hexdigest()


def residuals(pushes: PushSet, mean_function: MeanFunction) -> Array:
    """(3, n) displacements minus the mean function, one contiguous row per output."""
    expected, _ = mean_function.evaluate(pushes.p_y, pushes.beta)
    return np.ascontiguousarray((pushes.displacement - expected).T)


def mean_function_name(mean_function: MeanFunction) -> str:
    """'zero' or 'analytical'."""
    return 'analytical' if isinstance(mean_function, ConeMean) else 'zero'
