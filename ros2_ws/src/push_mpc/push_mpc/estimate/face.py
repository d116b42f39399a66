"""Finds out where the pushed face really is: where the object moves with the tip.

If the object is larger than it is said to be, the measured gap is never closed, and without this
the controller would take the contact for lost. A gap that stays the same while the tip advances
and the object moves with it is none.
"""

import math

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

_TRAVEL = 0.01  # [m] of pushing that shows where the face is
_FILTER = 0.05  # [m] of pushing over which the estimate is averaged afterwards
_SPREAD = 2e-3  # [m]; a gap that changes by more is one
_FOLLOWED = 0.8  # share of the tip's advance by which the object moves with it
_LEAST = 1.5e-3  # [m]; a smaller offset is noise or the give of the contact
_LARGEST = 0.01  # [m]; a deeper overlap is a fault, see the guard


class FaceEstimator:
    """Offset of the face from where the size of the object says that it is.

    Attributes:
        offset: towards the tip [m]; 0 until it is known to be more than measurements explain.
    """

    def __init__(self, slider: Slider) -> None:
        """Starts from zero."""
        self.offset = 0.0
        self._slider = slider
        self._seen: tuple[Array, Array] | None = None
        self._advance = self._followed = self._gap = 0.0

    def reset(self) -> None:
        """Forgets the object."""
        self.offset = 0.0
        self._seen = None
        self._advance = self._followed = 0.0

    def observe(self, object_pose: Array, tip: Array) -> None:
        """Takes a measured object pose (3,) and tip position (2,)."""
        before, self._seen = self._seen, (object_pose, tip)
        if before is None:
            return
        gap = self._slider.gap(object_pose, tip)
        cos, sin = math.cos(object_pose[2]), math.sin(object_pose[2])
        advance = float(cos * (tip[0] - before[1][0]) + sin * (tip[1] - before[1][1]))
        if advance <= 0.0 or abs(gap - self._gap) > _SPREAD or abs(gap) > _LARGEST:
            self._advance = self._followed = 0.0
        if advance <= 0.0:
            self._gap = gap
            return
        change = gap - self._slider.gap(*before)
        self._advance += advance
        self._followed += advance + change
        share = advance / min(self._advance, _FILTER)
        self._gap += min(share, 1.0) * (gap - self._gap)
        if self._advance > _TRAVEL and self._followed > _FOLLOWED * self._advance:
            self.offset = self._gap if abs(self._gap) > _LEAST else 0.0

    def touching(self, object_pose: Array, tip: Array) -> Array:
        """The tip (2,) moved along the normal of the face, so that its gap is the real one."""
        if self.offset == 0.0:
            return tip
        heading = object_pose[2]
        return tip + self.offset * np.array([math.cos(heading), math.sin(heading)])
