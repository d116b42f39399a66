"""Coordinate axes in the plane, possibly mirrored, and transformations to and from them.

They use plain numbers: at this size these are several times faster than arrays.
"""

import math

from push_core.physics import Pair


def turned(vector: Pair, cos: float, sin: float) -> Pair:
    """A vector expressed in axes that are rotated by the angle with this cosine and sine."""
    return cos * vector[0] + sin * vector[1], cos * vector[1] - sin * vector[0]


class Axes:
    """Axes with origin x, y [m] and heading theta [rad]; `side` -1 mirrors their y axis."""

    __slots__ = ('cos', 'side', 'sin', 'theta', 'x', 'y')

    def __init__(self, x: float, y: float, theta: float, side: float = 1.0) -> None:
        self.x, self.y, self.theta, self.side = x, y, theta, side
        self.cos, self.sin = math.cos(theta), math.sin(theta)

    def vector_from_world(self, vector: Pair) -> Pair:
        """A world vector in these axes."""
        x, y = turned(vector, self.cos, self.sin)
        return x, self.side * y

    def vector_to_world(self, vector: Pair) -> Pair:
        """A vector of these axes in the world."""
        return turned((vector[0], self.side * vector[1]), self.cos, -self.sin)

    def point_from_world(self, point: Pair) -> Pair:
        """A world point in these axes."""
        return self.vector_from_world((point[0] - self.x, point[1] - self.y))

    def point_to_world(self, point: Pair) -> Pair:
        """A point of these axes in the world."""
        x, y = self.vector_to_world(point)
        return self.x + x, self.y + y

    def heading_from_world(self, theta: float) -> float:
        """A world heading [rad] in these axes."""
        return self.side * (theta - self.theta)

    def heading_to_world(self, theta: float) -> float:
        """A heading [rad] of these axes in the world."""
        return self.theta + self.side * theta
