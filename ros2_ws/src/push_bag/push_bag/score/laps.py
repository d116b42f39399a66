"""The error of each lap of a closed track; the laps take equal shares of the reference's time."""

import math
from typing import Any

import numpy as np

from push_bag.run import Reference
from push_bag.score.tracking import Tracking


def per_lap(
    reference: Reference, tracking: Tracking, truth: Tracking | None
) -> list[dict[str, Any]]:
    """Figures of each lap that was begun.

    Args:
        reference: that the run followed.
        tracking: errors of the measured poses.
        truth: errors of the true poses; None without ground truth.

    Returns:
        Mean and largest tracking error, mean error of the true pose [mm], and what was identified
        during the lap: None, as no controller identifies anything yet.
    """
    measured = _by_lap(reference, tracking)
    true = [] if truth is None else _by_lap(reference, truth)
    return [
        {
            'mean_mm': float(errors.mean()) if errors.size else math.nan,
            'max_mm': float(errors.max(initial=-math.inf)) if errors.size else math.nan,
            'truth_mean_mm': float(true[lap].mean()) if true and true[lap].size else math.nan,
            'identified': None,
        }
        for lap, errors in enumerate(measured)
        if any(later.size for later in measured[lap:])
    ]


def _by_lap(reference: Reference, tracking: Tracking) -> list[Any]:
    """Tracking errors (n,) [mm] of each lap."""
    share = tracking.reference_time / reference.duration * reference.laps
    # the end of a lap still belongs to it
    lap = np.ceil(share - 1e-9).astype(np.intp) - 1
    return [tracking.distance[lap == each] * 1e3 for each in range(reference.laps)]
