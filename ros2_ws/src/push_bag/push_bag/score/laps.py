"""The figures of each lap of a closed track: laps take equal shares of the reference's time."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from push_bag.run import DrivenLesson, Reference
from push_bag.score.tracking import Tracking


def per_lap(
    reference: Reference,
    tracking: Tracking,
    truth: Tracking | None,
    lessons: Sequence[DrivenLesson],
) -> list[dict[str, Any]]:
    """Figures of each lap that was begun.

    Args:
        reference: that the run followed.
        tracking: errors of the measured poses.
        truth: errors of the true poses; None without ground truth.
        lessons: that drove the run.

    Returns:
        Mean and largest tracking error, mean error of the true pose [mm], and what had been
        identified when the lap ended; None where nothing had been.
    """
    measured = _by_lap(reference, tracking)
    true = [] if truth is None else _by_lap(reference, truth)
    ends = [_end(tracking, poses) for poses in _poses(reference, tracking)]
    return [
        {
            'mean_mm': float(errors.mean()) if errors.size else math.nan,
            'max_mm': float(errors.max(initial=-math.inf)) if errors.size else math.nan,
            'truth_mean_mm': float(true[lap].mean()) if true and true[lap].size else math.nan,
            'identified': _identified(lessons, ends[lap]),
        }
        for lap, errors in enumerate(measured)
        if any(later.size for later in measured[lap:])
    ]


def _identified(lessons: Sequence[DrivenLesson], end: int) -> dict[str, float] | None:
    """What drove the tick with a stamp [ns]."""
    driven = [each for each in lessons if each.since <= end]
    if not driven or not driven[-1].pushes:
        return None
    (friction, friction_std), (radius, radius_std) = driven[-1].friction, driven[-1].support_radius
    return {
        'friction': friction,
        'friction_std': friction_std,
        'support_radius_mm': 1e3 * radius,
        'support_radius_std_mm': 1e3 * radius_std,
        'pushes': driven[-1].pushes,
    }


def _by_lap(reference: Reference, tracking: Tracking) -> list[Any]:
    """Tracking errors (n,) [mm] of each lap."""
    return [tracking.distance[each] * 1e3 for each in _poses(reference, tracking)]


def _poses(reference: Reference, tracking: Tracking) -> list[NDArray[np.bool_]]:
    """Whether each pose (n,) belongs to each of the laps."""
    share = tracking.reference_time / reference.duration * reference.laps
    # the end of a lap still belongs to it
    lap = np.ceil(share - 1e-9).astype(np.intp) - 1
    return [lap == each for each in range(reference.laps)]


def _end(tracking: Tracking, lap: NDArray[np.bool_]) -> int:
    """Stamp [ns] of the last pose of a lap; 0 without any."""
    return int(tracking.stamp[lap].max(initial=0))
