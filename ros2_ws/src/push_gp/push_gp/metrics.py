"""How well a model tells measured pushes: RMSE, NMSE in two frames, likelihood, coverage."""

import math
from dataclasses import dataclass

import numpy as np
from push_core.frames import Array
from push_core.push_set import PushSet

from push_gp.gp_model import GpModel
from push_gp.model import PushModel

TWO_SIDED_95 = 1.959963984540054
"""Standard deviations on each side of the mean that hold 95 % of a normal distribution."""


@dataclass(frozen=True)
class Accuracy:
    """Errors of a model on n pushes.

    Attributes:
        n: pushes compared.
        rmse: (3,) root mean squared errors in the body frame [m, m, rad].
        nmse_push_frame: (3,) mean squared errors over the variance of the measurement, with the
            translation turned into the direction of the push.
        nmse_body_frame: (3,) the same in the body frame.
    """

    n: int
    rmse: Array
    nmse_push_frame: Array
    nmse_body_frame: Array


@dataclass(frozen=True)
class Calibration:
    """How honest the variances of a model are.

    Attributes:
        nlpd: (3,) mean negative log predictive density [nat], outputs in [mm, mm, deg].
        coverage_95: (3,) share of measurements within the 95 % interval.
    """

    nlpd: Array
    coverage_95: Array


def accuracy(model: PushModel, pushes: PushSet) -> Accuracy:
    """Compares the model's mean with measured pushes of the same distance."""
    predicted, _ = model.evaluate(pushes.p_y, pushes.beta)
    error = predicted - pushes.displacement
    return Accuracy(
        n=len(pushes),
        rmse=np.sqrt(np.mean(error**2, axis=0)),
        nmse_push_frame=_nmse(
            in_push_frame(error, pushes.beta), in_push_frame(pushes.displacement, pushes.beta)
        ),
        nmse_body_frame=_nmse(error, pushes.displacement),
    )


def calibration(model: GpModel, pushes: PushSet) -> Calibration:
    """Compares the model's distribution of a measurement with measured pushes."""
    predicted, _ = model.evaluate(pushes.p_y, pushes.beta)
    variance = model.variance(pushes.p_y, pushes.beta) + model.noise_variance
    squared = (predicted - pushes.displacement) ** 2 / variance
    unit = np.array([1e-3, 1e-3, math.radians(1.0)])
    density = 0.5 * (squared + np.log(2.0 * math.pi * variance / unit**2))
    return Calibration(density.mean(axis=0), np.mean(squared <= TWO_SIDED_95**2, axis=0))


def in_push_frame(displacement: Array, beta: Array) -> Array:
    """(n, 3) displacements with their translation along and across the push direction.

    Args:
        displacement: (n, 3) in the body frame.
        beta: (n,) push directions [rad]; the push goes along [sin(beta), cos(beta)].
    """
    sin, cos = np.sin(beta), np.cos(beta)
    dx, dy, dtheta = displacement.T
    return np.column_stack((sin * dx + cos * dy, -cos * dx + sin * dy, dtheta))


def _nmse(error: Array, measured: Array) -> Array:
    spread = np.var(measured, axis=0)
    mean_squared = np.mean(error**2, axis=0)
    # one push, or pushes that all do the same, have no variance to compare with
    ratio = np.full(3, np.nan)
    np.divide(mean_squared, spread, out=ratio, where=spread > 0)
    return ratio
