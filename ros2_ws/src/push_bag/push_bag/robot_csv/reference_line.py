"""The straight line that a robot run followed: the x axis, or the line that fits its poses."""

import math
from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.data import RobotRun

from push_bag.run import Floats

AXIS_ANGLE = math.radians(3.0)  # of the commanded motion, for the x axis to be the reference
AXIS_DISTANCE = 0.02  # [m] of the object's first position, likewise
STRAIGHT = 0.3  # largest ratio of the poses' extents across and along a line
STILL = 2e-3  # [m] of the object's motion; less is noise of its sensor


@dataclass(frozen=True)
class ReferenceLine:
    """A line in the plane with a direction.

    Attributes:
        foot: (2,) of its points the nearest to the origin [m].
        heading: of its direction [rad].
        text: what it is, for the user.
    """

    foot: Floats
    heading: float
    text: str

    @property
    def direction(self) -> Floats:
        """Unit vector (2,)."""
        return np.array([math.cos(self.heading), math.sin(self.heading)])

    def along(self, points: Floats) -> Floats:
        """Positions (n,) [m] of points (n, 2) along the line, from its foot."""
        return np.asarray(points @ self.direction)

    def points(self, along: Floats) -> Floats:
        """Points (n, 2) [m] at positions (n,) along the line."""
        return np.asarray(self.foot + along[:, np.newaxis] * self.direction)


X_AXIS = ReferenceLine(np.zeros(2), 0.0, 'the x axis')


def reference_line(run: RobotRun) -> ReferenceLine:
    """The line that a run followed.

    The x axis if the robot was commanded along it and the object began near it; then a constant
    offset from it is an error. Else the line that fits the object's positions best.

    Raises:
        InputError: the object does not move, or does not follow a line.
    """
    points = run.pose[:, :2]
    if np.linalg.norm(points - points[0], axis=1).max() < STILL:
        raise InputError(f'{run.name}: the object does not move in the whole run')
    commanded = run.commanded[-1] - run.commanded[0]
    ahead = abs(math.atan2(commanded[1], commanded[0])) <= AXIS_ANGLE
    if ahead and abs(points[0, 1]) <= AXIS_DISTANCE:
        return X_AXIS
    return _fitted(run.name, points)


def _fitted(name: str, points: Floats) -> ReferenceLine:
    centre = points.mean(axis=0)
    _, extents, axes = np.linalg.svd(points - centre, full_matrices=False)
    if extents[1] > STRAIGHT * extents[0]:
        raise InputError(f'{name}: the object does not follow a straight line')
    direction = axes[0] * (1.0 if axes[0] @ (points[-1] - points[0]) > 0.0 else -1.0)
    heading = math.atan2(direction[1], direction[0])
    foot = centre - (centre @ direction) * direction
    text = f'a line at {math.degrees(heading):.1f} deg, fitted to the positions of the object'
    return ReferenceLine(foot, heading, text)
