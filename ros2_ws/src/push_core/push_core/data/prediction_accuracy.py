"""Prediction error of displacements: RMSE, and NMSE in two frames."""

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from push_core.data.push_set import PushSet
from push_core.geometry import Array

OUTPUTS = ('dx', 'dy', 'dtheta')
READABLE = np.array([1e-3, 1e-3, math.radians(1.0)])
"""mm, mm and degrees in [m, m, rad]."""

Figures: TypeAlias = dict[str, float | None]


@dataclass(frozen=True)
class Accuracy:
    """Errors of a prediction of n pushes.

    Attributes:
        n: pushes compared.
        rmse: (3,) root mean squared errors in the body frame [m, m, rad].
        nmse_push_frame: (3,) mean squared errors over the variance of the measurements, with the
            translation along and across the push direction; NaN where that variance is zero.
        nmse_body_frame: (3,) the same in the body frame.
    """

    n: int
    rmse: Array
    nmse_push_frame: Array
    nmse_body_frame: Array

    def as_json(self) -> dict[str, int | Figures]:
        """The errors as in the JSON of every command."""
        rmse = self.rmse / READABLE
        return {
            'n': self.n,
            'rmse': dict(zip(('dx_mm', 'dy_mm', 'dtheta_deg'), rmse.tolist(), strict=True)),
            'nmse_push_frame': with_mean(self.nmse_push_frame),
            'nmse_body_frame': with_mean(self.nmse_body_frame),
        }


def accuracy(predicted: Array, pushes: PushSet) -> Accuracy:
    """Compares predictions (n, 3) in the body frame [m, m, rad] with n measured pushes."""
    error = predicted - pushes.displacement
    return Accuracy(
        n=len(pushes),
        rmse=np.sqrt(np.mean(error**2, axis=0)),
        nmse_push_frame=_nmse(
            in_push_frame(error, pushes.beta), in_push_frame(pushes.displacement, pushes.beta)
        ),
        nmse_body_frame=_nmse(error, pushes.displacement),
    )


def in_push_frame(displacement: Array, beta: Array) -> Array:
    """Displacements (n, 3) with their translation along and across the push direction.

    Args:
        displacement: (n, 3) in the body frame.
        beta: (n,) push directions [rad]; the push goes along [sin(beta), cos(beta)].
    """
    sin, cos = np.sin(beta), np.cos(beta)
    dx, dy, dtheta = displacement.T
    return np.column_stack((sin * dx + cos * dy, -cos * dx + sin * dy, dtheta))


def per_output(values: Array) -> Figures:
    """Three values by the name of their output; None for NaN, which JSON lacks."""
    return {
        name: value if math.isfinite(value) else None
        for name, value in zip(OUTPUTS, values.tolist(), strict=True)
    }


def with_mean(values: Array) -> Figures:
    """Three values by the name of their output, and their mean."""
    mean = float(values.mean())
    return {**per_output(values), 'mean': mean if math.isfinite(mean) else None}


def _nmse(error: Array, measured: Array) -> Array:
    spread = np.var(measured, axis=0)
    ratio = np.full(3, np.nan)
    # a single push, or equal pushes, have no variance
    np.divide(np.mean(error**2, axis=0), spread, out=ratio, where=spread > 0)
    return ratio
