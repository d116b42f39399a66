"""Planar frames: a pose is [x m, y m, theta rad] of the body frame in the world frame."""

import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[Any]


def wrap_angle(angle: float) -> float:
    """The same angle [rad] in [-pi, pi], without rounding."""
    return math.remainder(angle, math.tau)


def wrap_angles(angles: Array) -> Array:
    """The same angles (n,) [rad] in [-pi, pi), rounded."""
    return np.asarray((angles + np.pi) % (2.0 * np.pi) - np.pi)


def rotation(theta: float) -> Array:
    """Rotation matrix (2, 2) that turns body vectors into world vectors."""
    cos, sin = math.cos(theta), math.sin(theta)
    return np.array([[cos, -sin], [sin, cos]])


def to_world(pose: Array, point: Array) -> Array:
    """World position (2,) [m] of a point (2,) given in the body frame of `pose` (3,)."""
    return np.asarray(pose[:2] + rotation(pose[2]) @ point)


def to_body(pose: Array, point: Array) -> Array:
    """Position (2,) [m] in the body frame of `pose` (3,) of a point (2,) given in the world."""
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    x, y = point[0] - pose[0], point[1] - pose[1]
    return np.array([cos * x + sin * y, cos * y - sin * x])


def points_to_body(poses: Array, points: Array) -> Array:
    """Positions (n, 2) [m] in the body frames of `poses` (n, 3) of world points (n, 2)."""
    cos, sin = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    x, y = (points - poses[:, :2]).T
    return np.column_stack((cos * x + sin * y, cos * y - sin * x))
