"""Yaw as a unit quaternion and back without loss.

Sines and arc tangents round, so a yaw would come out of a quaternion a few bits away. Yaws are
therefore kept on a grid of 2^-40 rad (1e-12 rad): whether a pose crosses a network as a quaternion
or is handed over directly, its reader gets the same number.
"""

import math

_STEPS_PER_RADIAN = 2.0**40
_HALF_TURN = math.floor(math.pi * _STEPS_PER_RADIAN)


def grid_yaw(yaw: float) -> float:
    """The nearest yaw [rad] that a trip through a quaternion leaves as it is, in [-pi, pi]."""
    steps = round(math.remainder(yaw, math.tau) * _STEPS_PER_RADIAN)
    return max(-_HALF_TURN, min(_HALF_TURN, steps)) / _STEPS_PER_RADIAN


def yaw_to_quaternion(yaw: float) -> tuple[float, float, float, float]:
    """Quaternion (x, y, z, w) of a rotation by yaw [rad] about z."""
    return 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw)


def quaternion_to_yaw(z: float, w: float) -> float:
    """Yaw [rad] on the grid, of the quaternion's twist about z; a tilt (x, y) does not matter."""
    return grid_yaw(2.0 * math.atan2(z, w))
