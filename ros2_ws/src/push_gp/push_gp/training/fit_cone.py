"""Fits the motion cone to pushes: pusher friction and support radius."""

import numpy as np
from push_core.data import HALF_FACE, PushSet
from push_core.geometry import Array
from push_core.physics import Slider
from scipy.optimize import least_squares

from push_gp.models import AnalyticalModel

NOMINAL = Slider(friction_pusher=0.3, support_radius=0.0344)
"""Tabulated friction, and the support radius of uniform pressure."""

PRIOR_WIDTH = np.array([0.12, 0.012])
"""Prior standard deviations of the logarithms of friction and support radius about the nominal."""

MISFIT = 0.1
"""Typical residual of the motion cone over the distance; it weighs data against the prior."""

LARGEST_CHANGE = 1.0


def fitted_cone(pushes: PushSet) -> AnalyticalModel:
    """The motion cone that fits the pushes best.

    Robust least squares with a prior on the logarithms of both parameters: with few pushes they
    stay near the nominal values.
    """
    unit = np.array([1.0, 1.0, 1.0 / HALF_FACE]) * pushes.distance * MISFIT

    def misfit(logarithms: Array) -> Array:
        expected, _ = _cone(logarithms, pushes.distance).evaluate(pushes.p_y, pushes.beta)
        residuals = (pushes.displacement - expected) / unit
        return np.concatenate((residuals.ravel(), logarithms / PRIOR_WIDTH))

    bounds = (-LARGEST_CHANGE, LARGEST_CHANGE)
    result = least_squares(misfit, np.zeros(2), bounds=bounds, loss='soft_l1')
    return _cone(result.x, pushes.distance)


def _cone(logarithms: Array, distance: float) -> AnalyticalModel:
    friction, radius = np.exp(logarithms).tolist()
    slider = Slider(
        friction_pusher=NOMINAL.friction_pusher * friction,
        support_radius=NOMINAL.support_radius * radius,
    )
    return AnalyticalModel(slider, distance)
