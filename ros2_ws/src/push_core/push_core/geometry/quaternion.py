"""Yaw to unit quaternion and back without loss.

Sine and arc tangent round, so the conversion alone changes the last bits of a yaw. Yaws are
therefore rounded to a grid of 2^-40 rad (1e-12 rad): a pose has the same yaw whether it is sent as
a quaternion or passed directly.
"""

import math

_STEPS_PER_RADIAN = 2.0**40
_HALF_TURN = math.floor(math.pi * _STEPS_PER_RADIAN)


def grid_yaw(yaw: float) -> float:
    """The yaw [rad] rounded to the grid, in [-pi, pi]."""
    steps = round(math.remainder(yaw, math.tau) * _STEPS_PER_RADIAN)
    return max(-_HALF_TURN, min(_HALF_TURN, steps)) / _STEPS_PER_RADIAN


def yaw_to_quaternion(yaw: float) -> tuple[float, float, float, float]:
    """Quaternion (x, y, z, w) of a rotation by yaw [rad] about z."""
    return 0.0, 0.0, math.sin(0.5 * yaw), math.cos(0.5 * yaw)


def quaternion_to_yaw(z: float, w: float) -> float:
    """Yaw [rad] on the grid, of a quaternion with components z and w; the tilt is ignored."""
    return grid_yaw(2.0 * math.atan2(z, w))
