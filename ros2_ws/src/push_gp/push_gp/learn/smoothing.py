"""Measures the noise of the camera in a stretch of poses, and smooths it away over the path.

White noise is what a pose differs by from the line between its neighbours, since a push moves the
object evenly from one picture to the next.
"""

import math
from dataclasses import dataclass

import numpy as np
from push_core.data import HALF_FACE
from push_core.geometry import Array

ACCURACY = 0.025
"""Standard deviation that the noise of a pose shall leave in a push, over its distance."""

WIDEST = 0.025
"""Largest distance [m] from a place to the poses that it is smoothed from."""

FEWEST_POSES = 8
"""Poses from which noise is measured; in fewer there is none."""

_NORMAL = 0.6745  # median of the absolute value of a standard normal variable


@dataclass(frozen=True)
class PoseNoise:
    """White noise of the poses of an object.

    Attributes:
        position: standard deviation of x and y [m].
        angle: of the heading [rad].
        spacing: way of the tip from one pose to the next [m].
    """

    position: float = 0.0
    angle: float = 0.0
    spacing: float = 0.0

    def width(self, distance: float) -> float:
        """Distance [m] over which poses are smoothed to be good for pushes of a distance [m].

        A line through the poses within h to both sides has the slope to within
        sigma sqrt(1.5 spacing / h^3).
        """
        sigma = max(self.position, self.angle * HALF_FACE)
        width = (sigma * math.sqrt(1.5 * self.spacing) / ACCURACY) ** (2.0 / 3.0)
        return min(width, WIDEST) if width > distance else 0.0


def pose_noise(object_poses: Array, tips: Array) -> PoseNoise:
    """The noise of poses (m, 3) in the order of time, for tips (m, 2); few jumps are none."""
    if len(object_poses) < FEWEST_POSES:
        return PoseNoise()
    moved = np.hypot(*np.diff(tips, axis=0).T)
    both = moved[:-1] + moved[1:]
    share = np.divide(moved[:-1], both, out=np.full_like(both, 0.5), where=both > 0.0)[:, None]
    before, here, after = object_poses[:-2], object_poses[1:-1], object_poses[2:]
    off = here - (1.0 - share) * before - share * after
    white = np.abs(off) / np.sqrt(1.0 + share**2 + (1.0 - share) ** 2)
    x, y, angle = (np.median(white, axis=0) / _NORMAL).tolist()
    return PoseNoise(math.hypot(x, y) / math.sqrt(2.0), angle, float(np.median(moved)))


def smoothed_at(marks: Array, travel: Array, values: Array, width: float) -> Array:
    """Values (m, k) at marks (n,) of the travel: of lines through what lies within a width.

    Args:
        marks: (n,) along the way of the tip [m].
        travel: (m,) where the values were measured [m], not falling.
        values: (m, k).
        width: to both sides of a mark [m]; with 0 the lines join neighbours.
    """
    if width <= 0.0 or len(travel) < FEWEST_POSES:
        return np.column_stack([np.interp(marks, travel, column) for column in values.T])
    result = np.empty((len(marks), values.shape[1]))
    first = np.searchsorted(travel, marks - width)
    last = np.searchsorted(travel, marks + width, side='right')
    # so many that a line is determined, where poses are missing
    first = np.clip(np.minimum(first, last - FEWEST_POSES), 0, len(travel) - FEWEST_POSES)
    last = np.maximum(last, first + FEWEST_POSES)
    for row, (begin, end, mark) in enumerate(zip(first, last, marks, strict=True)):
        lever = travel[begin:end] - mark
        mean = lever.mean()
        spread = float(np.sum((lever - mean) ** 2))
        level = values[begin:end].mean(axis=0)
        slope = (lever - mean) @ values[begin:end] / spread if spread > 0.0 else 0.0
        result[row] = level - mean * slope
    return result
