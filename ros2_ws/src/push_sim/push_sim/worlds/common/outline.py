"""Where the round tip's centre is when it touches the square: a square with rounded corners.

The curve has eight pieces, a face and a corner in turns, and runs from the face x = -side/2
towards +y and on round the corner. Each place on it, told by its length `along`, has a contact
frame: x along the inward normal, y along the curve.
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
_ROUNDING = 1e-9


class Outline:
    """The curve of the tip's centre about a square of a side, for a tip of a radius [m]."""

    def __init__(self, side: float, tip_radius: float) -> None:
        self.tip_radius = tip_radius
        self._half = side / 2.0
        lengths = [side, _QUARTER * tip_radius] * 4
        self._ends = list(accumulate(lengths))
        self._starts = [0.0, *self._ends[:-1]]

    @property
    def length(self) -> float:
        """Length [m] of the whole curve."""
        return self._ends[-1]

    def piece(self, along: float) -> int:
        """Which piece a place lies on: even numbers are faces, odd ones corners."""
        return bisect_right(self._ends, along % self.length) % 8

    def frame(self, along: float, piece: int) -> tuple[float, float, float]:
        """Angle [rad] of the inward normal and position [normal, tangential] of the contact.

        A piece goes on smoothly beyond its ends.
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
        """Distance [m] of a tip at a body-frame point from the square; negative inside."""
        over_x, over_y = abs(x) - self._half, abs(y) - self._half
        if over_x > 0.0 and over_y > 0.0:
            return math.hypot(over_x, over_y) - self.tip_radius
        return max(over_x, over_y) - self.tip_radius

    def nearest(self, x: float, y: float) -> float:
        """The place of the outline that is nearest to a body-frame point."""
        face = _face_before_corner(x, y) if self._off_corner(x, y) else _face_towards(x, y)
        normal, tangential = _SEEN_FROM_FACE[face](x, y)
        if tangential <= self._half:
            return self._starts[2 * face] + tangential + self._half
        turn = math.atan2(tangential - self._half, -normal - self._half)
        return self._starts[2 * face + 1] + turn * self.tip_radius

    def _off_corner(self, x: float, y: float) -> bool:
        return abs(x) > self._half and abs(y) > self._half

    def made_room(self, pose: Pose, tip: Pair) -> Pose:
        """A pose of the square, moved aside as far as it overlaps with a tip [m]."""
        axes = Axes(*pose)
        if self.gap(*axes.point_inside(tip)) >= 0.0:
            return pose
        return self.touching(self.nearest(*axes.point_inside(tip)), pose[2], tip)

    def touched(self, pose: Pose, tip: Pair) -> Pose:
        """A pose that touches the tip by a nanometre, if it does so but for rounding."""
        place = Axes(*pose).point_inside(tip)
        if abs(self.gap(*place)) > _ROUNDING:
            return pose
        along = self.nearest(*place)
        x, y, theta = self.touching(along, pose[2], tip)
        normal = theta + self.frame(along, self.piece(along))[0]
        return x - _ROUNDING * math.cos(normal), y - _ROUNDING * math.sin(normal), theta

    def touching(self, along: float, theta: float, tip: Pair) -> Pose:
        """The pose of heading theta [rad] that a tip [m] touches at a place of the outline."""
        angle, normal, tangential = self.frame(along, self.piece(along))
        contact = Axes(0.0, 0.0, theta + angle)
        x, y = contact.vector_outside((normal - self.tip_radius, tangential))
        return tip[0] - x, tip[1] - y, theta


def _face_before_corner(x: float, y: float) -> int:
    if x < 0.0:
        return 0 if y > 0.0 else 3
    return 1 if y > 0.0 else 2


def _face_towards(x: float, y: float) -> int:
    if abs(x) >= abs(y):
        return 0 if x < 0.0 else 2
    return 1 if y > 0.0 else 3


_SEEN_FROM_FACE: tuple[Callable[[float, float], Pair], ...] = (
    lambda x, y: (x, y),
    lambda x, y: (-y, x),
    lambda x, y: (-x, -y),
    lambda x, y: (y, -x),
)
