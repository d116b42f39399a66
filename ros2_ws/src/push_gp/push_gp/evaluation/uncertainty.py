"""Quality of predicted variances: likelihood of measured pushes, coverage of intervals."""

import math
from dataclasses import dataclass

import numpy as np
from push_core.data import READABLE, PushSet
from push_core.geometry import Array

from push_gp.models import GpModel, PushModel


@dataclass(frozen=True)
class UncertaintyScore:
    """Score of the predicted distribution of a measurement.

    Attributes:
        nlpd: (3,) mean negative log predictive density [nat], outputs in [mm, mm, deg].
        coverage_95: (3,) share of measurements within the 95 % interval.
    """

    nlpd: Array
    coverage_95: Array


def score_uncertainty(model: PushModel, pushes: PushSet) -> UncertaintyScore | None:
    """Compares the predicted distribution with measured pushes; None for a model without one."""
    if not isinstance(model, GpModel):
        return None
    predicted, _ = model.evaluate(pushes.p_y, pushes.beta)
    variance = model.variance(pushes.p_y, pushes.beta) + model.noise_variance
    squared = (predicted - pushes.displacement) ** 2 / variance
    density = 0.5 * (squared + np.log(2.0 * math.pi * variance / READABLE**2))
    return UncertaintyScore(density.mean(axis=0), np.mean(squared <= model.interval_95**2, axis=0))
