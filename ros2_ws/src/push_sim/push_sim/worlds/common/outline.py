"""The curve of the tip's centre in contact with the square: a square with rounded corners.

It has eight pieces, alternately faces and corners. Its arc length `along` [m] begins at the lower
end of the face x = -side/2 and increases towards +y. The contact frame of a point of the curve
has x along the inward normal and y along the curve.
"""

import math
from bisect import bisect_right
from collections.abc import Callable
from itertools import accumulate
from typing import TypeAlias

from push_core.physics import Pair

from push_sim.worlds.common.axes import Axes

Pose: TypeAlias = tuple[float, float, float]

_QUARTER = math.pi / 2.0
_SNAP = 1e-9


class Outline:
    """The curve around a square with a side [m], for a tip with a radius [m]."""

    def __init__(self, side: float, tip_radius: float) -> None:
        self.tip_radius = tip_radius
        self._half = side / 2.0
        lengths = [side, _QUARTER * tip_radius] * 4
        self._ends = list(accumulate(lengths))
        self._starts = [0.0, *self._ends[:-1]]

    @property
    def length(self) -> float:
        """Length [m] of the curve."""
        return self._ends[-1]

    def piece(self, along: float) -> int:
        """Number of the piece at an arc length: even numbers are faces, odd ones corners."""
        return bisect_right(self._ends, along % self.length) % 8

    def frame(self, along: float, piece: int) -> tuple[float, float, float]:
        """Contact frame of an arc length, on a piece that is extended beyond its ends.

        Returns:
            Angle [rad] of the inward normal, and position [normal, tangential] of the contact [m]
            in the contact frame.
        """
        half, start = self._half, self._starts[piece]
        distance = math.remainder(along - start, self.length)
        face_angle = -(piece // 2) * _QUARTER
        if piece % 2 == 0:
            return face_angle, -half, distance - half
        turn = distance / self.tip_radius
        cos, sin = math.cos(turn), math.sin(turn)
        return face_angle - turn, -half * (cos + sin), half * (cos - sin)

    def gap(self, x: float, y: float) -> float:
        """Distance [m] from the square to a tip at a body-frame position; negative in overlap."""
        over_x, over_y = abs(x) - self._half, abs(y) - self._half
        if over_x > 0.0 and over_y > 0.0:
            return math.hypot(over_x, over_y) - self.tip_radius
        return max(over_x, over_y) - self.tip_radius

    def nearest(self, x: float, y: float) -> float:
        """Arc length [m] of the point of the curve nearest to a body-frame position."""
        face = _face_before_corner(x, y) if self._off_corner(x, y) else _face_towards(x, y)
        normal, tangential = _IN_FACE_FRAME[face](x, y)
        if tangential <= self._half:
            return self._starts[2 * face] + tangential + self._half
        turn = math.atan2(tangential - self._half, -normal - self._half)
        return self._starts[2 * face + 1] + turn * self.tip_radius

    def _off_corner(self, x: float, y: float) -> bool:
        return abs(x) > self._half and abs(y) > self._half

    def without_overlap(self, pose: Pose, tip: Pair) -> Pose:
        """A pose of the square, moved to contact if it overlaps with a tip [m]."""
        axes = Axes(*pose)
        if self.gap(*axes.point_from_world(tip)) >= 0.0:
            return pose
        return self.pose_in_contact(self.nearest(*axes.point_from_world(tip)), pose[2], tip)

    def snapped_to_contact(self, pose: Pose, tip: Pair) -> Pose:
        """Snaps a pose that is in contact up to round-off to 1 nm of penetration."""
        position = Axes(*pose).point_from_world(tip)
        if abs(self.gap(*position)) > _SNAP:
            return pose
        along = self.nearest(*position)
        x, y, theta = self.pose_in_contact(along, pose[2], tip)
        normal = theta + self.frame(along, self.piece(along))[0]
        return x - _SNAP * math.cos(normal), y - _SNAP * math.sin(normal), theta

    def pose_in_contact(self, along: float, theta: float, tip: Pair) -> Pose:
        """The pose with heading theta [rad] that a tip [m] touches at an arc length."""
        angle, normal, tangential = self.frame(along, self.piece(along))
        contact = Axes(0.0, 0.0, theta + angle)
        x, y = contact.vector_to_world((normal - self.tip_radius, tangential))
        return tip[0] - x, tip[1] - y, theta


def _face_before_corner(x: float, y: float) -> int:
    if x < 0.0:
        return 0 if y > 0.0 else 3
    return 1 if y > 0.0 else 2


def _face_towards(x: float, y: float) -> int:
    if abs(x) >= abs(y):
        return 0 if x < 0.0 else 2
    return 1 if y > 0.0 else 3


_IN_FACE_FRAME: tuple[Callable[[float, float], Pair], ...] = (
    lambda x, y: (x, y),
    lambda x, y: (-y, x),
    lambda x, y: (-x, -y),
    lambda x, y: (y, -x),
)
