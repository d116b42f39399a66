"""Planar frames: a pose is [x m, y m, theta rad] of the body frame in the world frame."""

import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[Any]


def wrap_angle(angle: float) -> float:
    """The same angle [rad] in [-pi, pi)."""
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def rotation(theta: float) -> Array:
    """Rotation matrix (2, 2) that turns body vectors into world vectors."""
    cos, sin = math.cos(theta), math.sin(theta)
    return np.array([[cos, -sin], [sin, cos]])


def to_world(pose: Array, point: Array) -> Array:
    """World position (2,) [m] of a point (2,) given in the body frame of `pose` (3,)."""
    return np.asarray(pose[:2]) + rotation(pose[2]) @ np.asarray(point)


def to_body(pose: Array, point: Array) -> Array:
    """Position (2,) [m] in the body frame of `pose` (3,) of a point (2,) given in the world."""
    return rotation(pose[2]).T @ (np.asarray(point) - np.asarray(pose[:2]))
