"""Identifies the motion cone from pushes: friction of the tip and support radius.

Least squares with a Huber loss on the displacements, and a normal prior on the logarithms of both
parameters about the nominal ones. What the pushes do not tell stays at the prior: a tip that never
slides says only that the friction is high enough.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from push_core.data import HALF_FACE, PushSet
from push_core.geometry import Array, displacement_of, twist_of
from push_core.physics import HIGHEST_FRICTION, Slider, with_inertia
from scipy.optimize import OptimizeResult, least_squares

from push_gp.models import SmoothCone

PRIOR_WIDTH = np.array([0.6, 0.35])
"""Standard deviations of the logarithms of friction and support radius about the nominal."""

LARGEST_CHANGE = np.array([2.3, 1.0])
"""Bounds of these logarithms."""

MISFIT = 0.05
"""Residual of the cone over the distance beyond which a push counts less."""

STRETCH = 8
"""Pushes in a row whose residuals count as one: they share what the cone does not describe."""

STARTS = (0.0, -1.2, -0.6, 0.6, 1.2)
"""Logarithms of the friction, the best of which the search starts from: the loss has valleys."""

LONGEST_SEARCH = 30
"""Evaluations of the loss after which the search ends where it is."""

UP = np.array([1.0, 0.0])
"""Direction of more friction in these logarithms."""

DIFFERENCE = 1e-4
"""Step of the logarithms for numerical derivatives; the averaged cone has small kinks."""


@dataclass(frozen=True)
class Identified:
    """A motion cone and how well it is known.

    Attributes:
        model: the most likely cone.
        covariance: (2, 2) of the logarithms of friction and support radius.
        pushes: number of pushes that it was identified from.
    """

    model: SmoothCone
    covariance: Array
    pushes: int

    @property
    def friction(self) -> tuple[float, float]:
        """Friction of the tip and its standard deviation."""
        value = self.model.slider.friction_pusher
        return value, value * math.sqrt(self.covariance[0, 0])

    @property
    def support_radius(self) -> tuple[float, float]:
        """Support radius and its standard deviation [m]."""
        value = self.model.slider.support_radius
        return value, value * math.sqrt(self.covariance[1, 1])


def identified(pushes: PushSet, nominal: Slider, speed: float = 0.0) -> Identified:
    """The motion cone that a prior about the nominal one and pushes in a row tell of.

    Args:
        pushes: in the order of time; none leave the nominal cone.
        nominal: slider with the most likely parameters before any push.
        speed: of the object in the pushes whose inertia counts [m/s].
    """
    found = _search(pushes, nominal, speed)
    model = _cone(found.x, nominal, pushes.distance)
    return Identified(model, _covariance(found), len(pushes))


def _search(pushes: PushSet, nominal: Slider, speed: float) -> OptimizeResult:
    unit = np.array([1.0, 1.0, 1.0 / HALF_FACE]) * pushes.distance * MISFIT

    def weighted(logarithms: Array) -> Array:
        expected = expected_motion(_cone(logarithms, nominal, pushes.distance), pushes, speed)
        residuals = (pushes.displacement - expected) / unit
        return np.concatenate((huber_roots(residuals).ravel(), logarithms / PRIOR_WIDTH))

    # the first start wins a tie, so that what tells nothing changes nothing
    start = min(STARTS, key=lambda friction: round(float(np.sum(weighted(friction * UP) ** 2)), 9))
    return least_squares(
        weighted,
        start * UP,
        bounds=(-LARGEST_CHANGE, LARGEST_CHANGE),
        diff_step=DIFFERENCE,
        max_nfev=LONGEST_SEARCH,
    )


def expected_motion(cone: SmoothCone, pushes: PushSet, speed: float) -> Array:
    """Displacements (n, 3) in pushes at a speed [m/s] by a cone of slow ones."""
    mean, jacobian = cone.evaluate(pushes.p_y, pushes.beta)
    if speed <= 0.0:
        return mean
    fast = with_inertia(cone.slider, speed, pushes.p_y, *twist_of(mean, jacobian))
    return displacement_of(*fast)[0]


def huber_roots(residuals: Array) -> Array:
    """Numbers whose squares are the Huber loss of residuals: r^2 up to 1, then 2 |r| - 1."""
    size = np.abs(residuals)
    far = np.sqrt(np.maximum(2.0 * size - 1.0, 0.0))
    return np.asarray(np.copysign(np.where(size <= 1.0, size, far), residuals))


def _covariance(result: OptimizeResult) -> Array:
    """Sandwich estimate (2, 2) with stretches of pushes as clusters.

    Source: Liang and Zeger 1986. It does not take the residuals for white noise.
    """
    curvature = np.linalg.inv(result.jac.T @ result.jac)
    gradients = (result.jac * result.fun[:, None])[:-2].reshape(-1, 3, 2).sum(axis=1)
    whole = len(gradients) // STRETCH * STRETCH
    clusters = gradients[:whole].reshape(-1, STRETCH, 2).sum(axis=1)
    scatter = clusters.T @ clusters + np.diag(PRIOR_WIDTH**-2.0)
    return np.asarray(curvature @ scatter @ curvature)


def _cone(logarithms: Array, nominal: Slider, distance: float) -> SmoothCone:
    friction, radius = np.exp(logarithms).tolist()
    slider = replace(
        nominal,
        friction_pusher=min(nominal.friction_pusher * friction, HIGHEST_FRICTION),
        support_radius=nominal.support_radius * radius,
    )
    return SmoothCone(slider, distance)
