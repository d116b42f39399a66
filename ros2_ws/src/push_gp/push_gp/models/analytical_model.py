"""The motion cone of an ellipsoidal limit surface, with the interface of the learned model."""

import hashlib
import json
import math
from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np
from push_core.common import RunError
from push_core.data import check_distance
from push_core.geometry import Array, displacement_of
from push_core.physics import GRAZING, MotionCone, Slider

from push_gp.models.model import ModelInfo

ANALYTICAL = 'analytical'
"""Its name on command lines and in parameters, in place of the path of a model file."""

NOMINAL_DISTANCE = 0.004
"""Travel of the measured pushes [m]: 0.2 s at 20 mm/s."""


@dataclass(frozen=True)
class AnalyticalModel:
    """The motion cone of a slider for pushes of a `distance` [m]."""

    slider: Slider = Slider()
    distance: float = NOMINAL_DISTANCE

    def __post_init__(self) -> None:
        check_distance(self.distance)

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`."""
        rate, jacobian = MotionCone(self.slider).evaluate(p_y, beta)
        return displacement_of(rate * self.distance, jacobian * self.distance)

    def variance(self, p_y: Array, beta: Array) -> Array:
        """The motion cone has no variance.

        Raises:
            RunError: always.
        """
        raise RunError('the analytical model has no variance; call without want_variance')

    @cached_property
    def info(self) -> ModelInfo:
        """See `PushModel.info`; the domain is the whole face and all directions into it."""
        half = self.slider.side / 2.0
        return ModelInfo(
            model_hash=self._hash(),
            kind='analytical',
            mean_function='analytical',
            points=0,
            training_set_hash='',
            distance=self.distance,
            p_y_domain=(-half, half),
            beta_domain=(GRAZING, math.pi - GRAZING),
            lengthscales=np.zeros((3, 2)),
            signal_std=np.zeros(3),
            noise_std=np.zeros(3),
        )

    def _hash(self) -> str:
        identity = {'kind': 'analytical', 'distance': self.distance, **asdict(self.slider)}
        return hashlib.sha256(json.dumps(identity, sort_keys=True).encode()).hexdigest()
