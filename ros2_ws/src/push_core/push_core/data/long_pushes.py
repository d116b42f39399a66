"""Long straight pushes of a square: poses of object and tip before and after."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from push_core.geometry import Array, points_to_body, wrap_angle
from push_core.physics import Slider

FACE_MARGIN = 1e-3
"""Distance [m] beyond the end of the face within which a tip counts as on it: allows for a rounded
corner and the noise of the poses."""


@dataclass(frozen=True)
class EndErrors:
    """Errors of predicted end poses.

    Attributes:
        position: (n,) distances between the centres [m].
        heading: (n,) absolute differences of the headings [rad].
    """

    position: Array
    heading: Array

    def of(self, chosen: NDArray[np.bool_]) -> dict[str, float | int | None]:
        """The mean errors of the chosen (n,) pushes, as in the JSON of every command."""
        count = int(chosen.sum())
        return {
            'n': count,
            'mean_mm': 1e3 * float(self.position[chosen].mean()) if count else None,
            'mean_deg': math.degrees(self.heading[chosen].mean()) if count else None,
        }


@dataclass(frozen=True)
class LongPushes:
    """n straight pushes, world frame. Each pose is turned so that the pushed face is x = p_x.

    Attributes:
        slider: the square and the tip.
        start: (n, 3) object poses before [m, m, rad].
        end: (n, 3) object poses after.
        tip_start: (n, 2) tip positions before [m].
        tip_end: (n, 2) tip positions after.
    """

    slider: Slider
    start: Array
    end: Array
    tip_start: Array
    tip_end: Array

    @classmethod
    def on_any_face(
        cls, slider: Slider, start: Array, end: Array, tip_start: Array, tip_end: Array
    ) -> 'LongPushes':
        """Pushes on any face; turns each pose so that the pushed face is x = p_x."""
        x, y = points_to_body(start, tip_start).T
        quarter = np.round((np.arctan2(y, x) - math.pi) / (math.pi / 2.0)) * (math.pi / 2.0)
        turn = np.column_stack((np.zeros((len(start), 2)), quarter))
        return cls(slider, start + turn, end + turn, tip_start, tip_end)

    def __len__(self) -> int:
        return len(self.start)

    def take(self, rows: NDArray[np.intp]) -> 'LongPushes':
        """The pushes of the given row numbers, in their order."""
        columns = (self.start, self.end, self.tip_start, self.tip_end)
        return LongPushes(self.slider, *(column[rows] for column in columns))

    @property
    def direction(self) -> Array:
        """(n,) directions of travel of the tip [rad], world frame."""
        travel = self.tip_end - self.tip_start
        return np.asarray(np.arctan2(travel[:, 1], travel[:, 0]))

    @property
    def distance(self) -> Array:
        """(n,) travel of the tip [m]."""
        return np.asarray(np.hypot(*(self.tip_end - self.tip_start).T))

    @cached_property
    def on_face(self) -> NDArray[np.bool_]:
        """(n,) whether the tip is on the face at the end; it starts there."""
        p_y = points_to_body(self.end, self.tip_end)[:, 1]
        return np.asarray(np.abs(p_y) <= self.slider.side / 2.0 + FACE_MARGIN)

    def errors(self, end: Array) -> EndErrors:
        """Errors of predicted end poses (n, 3)."""
        gap = end - self.end
        heading = np.array([abs(wrap_angle(angle)) for angle in gap[:, 2].tolist()])
        return EndErrors(np.asarray(np.hypot(gap[:, 0], gap[:, 1])), heading)
