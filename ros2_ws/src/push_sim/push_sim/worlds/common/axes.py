"""Axes that lie somewhere in the plane, and what points and vectors are as seen from them.

Mirrored axes have their y axis on the other side.

Plain numbers: at this size they are several times faster than arrays.
"""

import math

from push_core.physics import Pair


def turned(vector: Pair, cos: float, sin: float) -> Pair:
    """A vector as seen from axes that are turned by the angle of this cosine and sine."""
    return cos * vector[0] + sin * vector[1], cos * vector[1] - sin * vector[0]


class Axes:
    """Axes with their origin at x, y [m], turned by theta [rad]; `side` -1 mirrors them."""

    __slots__ = ('cos', 'side', 'sin', 'theta', 'x', 'y')

    def __init__(self, x: float, y: float, theta: float, side: float = 1.0) -> None:
        self.x, self.y, self.theta, self.side = x, y, theta, side
        self.cos, self.sin = math.cos(theta), math.sin(theta)

    def vector_inside(self, vector: Pair) -> Pair:
        """A vector of the world as seen from these axes."""
        x, y = turned(vector, self.cos, self.sin)
        return x, self.side * y

    def vector_outside(self, vector: Pair) -> Pair:
        """A vector of these axes as seen from the world."""
        return turned((vector[0], self.side * vector[1]), self.cos, -self.sin)

    def point_inside(self, point: Pair) -> Pair:
        """A point of the world as seen from these axes."""
        return self.vector_inside((point[0] - self.x, point[1] - self.y))

    def point_outside(self, point: Pair) -> Pair:
        """A point of these axes as seen from the world."""
        x, y = self.vector_outside(point)
        return self.x + x, self.y + y

    def heading_inside(self, theta: float) -> float:
        """A heading [rad] of the world as seen from these axes."""
        return self.side * (theta - self.theta)

    def heading_outside(self, theta: float) -> float:
        """A heading [rad] of these axes as seen from the world."""
        return self.theta + self.side * theta
