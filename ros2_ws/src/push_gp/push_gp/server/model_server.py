"""The model server without ROS."""

import math
from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.data import PushSet, checked_pushes, input_fault
from push_core.geometry import Array

from push_gp.models import GpModel, ModelInfo, PushModel


@dataclass(frozen=True)
class Prediction:
    """Predictions for n pushes.

    Attributes:
        mean: (n, 3) displacements [m, m, rad].
        jacobian: (n, 3, 2) derivatives with respect to [p_y, beta].
        variance: (n, 3) of the latent function; (0, 3) if not requested.
    """

    mean: Array
    jacobian: Array
    variance: Array


class ModelServer:
    """Holds the model, checks queries, and adds pushes."""

    def __init__(self, model: PushModel, max_points: int) -> None:
        """Serves a model.

        Args:
            model: to serve.
            max_points: training pushes that the model may grow to; see `spread_rows`.
        """
        self._model = model
        self._max_points = max_points
        if isinstance(model, GpModel):
            # computes the Cholesky factors now, not at the first query
            self.predict(np.zeros(1), np.full(1, math.pi / 2.0), want_variance=True)

    @property
    def model(self) -> PushModel:
        """The current model."""
        return self._model

    @property
    def info(self) -> ModelInfo:
        """Description of the current model."""
        return self._model.info

    def serve(self, model: PushModel) -> None:
        """Answers for another model from now on."""
        self._model = model

    def predict(self, p_y: Array, beta: Array, *, want_variance: bool) -> Prediction:
        """Predicts a batch of pushes.

        Args:
            p_y: (n,) contact offsets [m].
            beta: (n,) push directions [rad].
            want_variance: whether to compute variances, which takes O(n^2) for n training pushes.

        Raises:
            InputError: the lengths differ, or a push is out of range.
            RunError: the model has no variance.
        """
        if p_y.size != beta.size:
            raise InputError(f'{p_y.size} p_y but {beta.size} beta')
        fault = input_fault(p_y, beta)
        if fault:
            raise InputError(f'push {fault[0]}: {fault[1]}')
        mean, jacobian = self._model.evaluate(p_y, beta)
        variance = self._model.variance(p_y, beta) if want_variance else np.empty((0, 3))
        return Prediction(mean, jacobian, variance)

    def add_pushes(self, pushes: PushSet) -> list[str]:
        """Adds pushes at the same hyperparameters; after an error the model is unchanged.

        Returns:
            Warnings: copies that were left out, what is odd in the pushes.

        Raises:
            InputError: the model is analytical, or the pushes are of another distance or
                contradict the physics of pushing.
            RunError: the pushes make its covariance singular.
        """
        if not isinstance(self._model, GpModel):
            raise InputError('the analytical model cannot be extended; serve a model file instead')
        if not len(pushes):
            raise InputError('there are no pushes to add')
        warnings: list[str] = []
        distinct = checked_pushes(pushes, 'added pushes', warn=warnings.append)
        self._model = self._model.extended(distinct).thinned(self._max_points)
        return warnings
