"""Answers for one model: what the node does, without ROS."""

import math
from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.data import PushSet, input_fault
from push_core.geometry import Array

from push_gp.models import GpModel, ModelInfo, PushModel


@dataclass(frozen=True)
class Prediction:
    """Answers for n pushes.

    Attributes:
        mean: (n, 3) displacements [m, m, rad].
        jacobian: (n, 3, 2) derivatives with respect to [p_y, beta].
        variance: (n, 3) of the mean; (0, 3) where nobody asked.
    """

    mean: Array
    jacobian: Array
    variance: Array


class ModelServer:
    """Holds the model, checks what is asked of it, and takes new pushes in."""

    def __init__(self, model: PushModel, max_points: int) -> None:
        """Serves a model.

        Args:
            model: to answer with.
            max_points: training pushes that it may grow to; see `thinning` for what it keeps.
        """
        self._model = model
        self._max_points = max_points
        if isinstance(model, GpModel):
            # factors now what the first question would otherwise wait for
            self.predict(np.zeros(1), np.full(1, math.pi / 2.0), want_variance=True)

    @property
    def model(self) -> PushModel:
        """The model by now."""
        return self._model

    @property
    def info(self) -> ModelInfo:
        """What the model is by now."""
        return self._model.info

    def predict(self, p_y: Array, beta: Array, *, want_variance: bool) -> Prediction:
        """Answers for a batch of pushes.

        Args:
            p_y: (n,) contact offsets [m].
            beta: (n,) push directions [rad].
            want_variance: it costs the square of the training pushes.

        Raises:
            InputError: the lengths differ, or a push is none.
            RunError: the model states no variance.
        """
        if p_y.size != beta.size:
            raise InputError(f'{p_y.size} p_y but {beta.size} beta')
        fault = input_fault(p_y, beta)
        if fault:
            raise InputError(f'push {fault[0]}: {fault[1]}')
        mean, jacobian = self._model.evaluate(p_y, beta)
        variance = self._model.variance(p_y, beta) if want_variance else np.empty((0, 3))
        return Prediction(mean, jacobian, variance)

    def add_pushes(self, pushes: PushSet) -> None:
        """Extends the model at its hyperparameters; it stays as it was if anything is wrong.

        Raises:
            InputError: it cannot learn, or the pushes do not fit it.
            RunError: the pushes make its covariance singular.
        """
        if not isinstance(self._model, GpModel):
            raise InputError('the analytical model does not learn; serve a model file instead')
        if not len(pushes):
            raise InputError('there are no pushes to add')
        self._model = self._model.extended(pushes).thinned(self._max_points)
