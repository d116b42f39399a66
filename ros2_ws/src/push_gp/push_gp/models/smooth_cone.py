"""The motion cone without its sharp edge: what is identified from pushes of a lap."""

import hashlib
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from push_core.physics import Slider

from push_gp.models.analytical_model import NOMINAL_DISTANCE, AnalyticalModel
from push_gp.models.mean_function import averaged
from push_gp.models.model import ModelInfo

BLUR = 0.1
"""Standard deviation [rad] of the push direction over which the cone is averaged.

Half of that of the prior mean of the Gaussian processes: nothing corrects this model afterwards.
With less a plan that agrees with its motion is often not found.
"""


@dataclass(frozen=True)
class SmoothCone:
    """The motion cone of a slider, averaged over the push direction; see `PushModel`."""

    slider: Slider = Slider()
    distance: float = NOMINAL_DISTANCE

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`."""
        return averaged(self._cone, np.column_stack((p_y, beta)), BLUR)

    def variance(self, p_y: Array, beta: Array) -> Array:
        """The motion cone has no variance.

        Raises:
            RunError: always.
        """
        raise RunError('the motion cone has no variance; call without want_variance')

    @cached_property
    def info(self) -> ModelInfo:
        """See `PushModel.info`; the domain is that of the sharp cone."""
        identity = f'smooth cone, {BLUR} rad, {self._cone.info.model_hash}'
        return replace(self._cone.info, model_hash=hashlib.sha256(identity.encode()).hexdigest())

    @property
    def _cone(self) -> AnalyticalModel:
        return AnalyticalModel(self.slider, self.distance)
