"""Safety limits of every velocity command: one pure function.

It checks for finite numbers, limits acceleration and speed (keeping the direction), keeps the
braking distance to the border of the workspace, and sends what is slower than a dead band as zero.
The workspace comes after the acceleration: braking for it may exceed that limit.
"""

import math
from dataclasses import dataclass

import numpy as np

from push_core.common import setting, validate
from push_core.geometry import Array

NOT_FINITE = 1
SPEED = 2
ACCELERATION = 4
WORKSPACE = 8
DEAD_BAND = 16

_FARTHEST = 1e6  # [m], [m/s]; a number beyond is as wrong as one that is not finite

LIMIT_NAMES = {
    NOT_FINITE: 'not_finite',
    SPEED: 'speed',
    ACCELERATION: 'acceleration',
    WORKSPACE: 'workspace',
    DEAD_BAND: 'dead_band',
}


@dataclass(frozen=True)
class SafetyLimits:
    """Limits of a velocity command."""

    speed: float = setting(0.25, 'largest commanded speed', unit='m/s', low=1e-3, high=2.0)
    acceleration: float = setting(
        5.0, 'largest change of command per time', unit='m/s^2', low=0.1, high=100.0
    )
    deceleration: float = setting(
        2.0, 'deceleration that the robot is sure to reach', unit='m/s^2', low=0.1, high=100.0
    )
    reaction_time: float = setting(
        0.11, 'time until a command acts, driven blindly', unit='s', low=0.0, high=1.0
    )
    workspace_x: float = setting(
        0.6, 'half width of the workspace about the origin', unit='m', low=0.05, high=5.0
    )
    workspace_y: float = setting(
        0.6, 'half depth of the workspace about the origin', unit='m', low=0.05, high=5.0
    )

    dead_band: float = setting(
        1e-5, 'speed below which a command is sent as zero', unit='m/s', low=0.0, high=0.01
    )

    def __post_init__(self) -> None:
        validate(self)


def limit(
    velocity: Array, previous: Array, position: Array, limits: SafetyLimits, period: float
) -> tuple[Array, int]:
    """The nearest allowed command.

    Args:
        velocity: requested tip velocity (2,) [m/s], world frame.
        previous: the command sent before it (2,) [m/s].
        position: tip position (2,) [m], world frame.
        limits: to apply.
        period: time [s] between two commands.

    Returns:
        The velocity (2,) to send, and the bits (see `LIMIT_NAMES`) of the limits that changed it.
    """
    if not all(abs(value) < _FARTHEST for value in (*velocity, *previous, *position)):
        return np.zeros(2), NOT_FINITE
    limited, bits = _limit_acceleration(velocity, previous, limits.acceleration * period)
    limited, speed_bit = _limit_speed(limited, limits.speed)
    limited, workspace_bit = _limit_workspace(limited, position, limits)
    limited, dead_bit = _without_dead_band(limited, limits.dead_band)
    return limited, bits | speed_bit | workspace_bit | dead_bit


def slowed(previous: Array, limits: SafetyLimits, period: float) -> tuple[Array, int]:
    """The command after `previous` (2,) [m/s] on the way to rest, and the bits of the limits."""
    if not all(abs(value) < _FARTHEST for value in previous):
        return np.zeros(2), NOT_FINITE
    return _limit_acceleration(np.zeros(2), previous, limits.acceleration * period)


def _limit_acceleration(velocity: Array, previous: Array, step: float) -> tuple[Array, int]:
    change = velocity - previous
    norm = math.hypot(change[0], change[1])
    if norm <= step:
        return velocity, 0
    return previous + change * (step / norm), ACCELERATION


def _limit_speed(velocity: Array, speed: float) -> tuple[Array, int]:
    norm = math.hypot(velocity[0], velocity[1])
    if norm <= speed:
        return velocity, 0
    return velocity * (speed / norm), SPEED


def _without_dead_band(velocity: Array, dead_band: float) -> tuple[Array, int]:
    if math.hypot(velocity[0], velocity[1]) >= dead_band or not velocity.any():
        return velocity, 0
    return np.zeros(2), DEAD_BAND


def _limit_workspace(velocity: Array, position: Array, limits: SafetyLimits) -> tuple[Array, int]:
    """Keeps each axis slow enough to stop, v <= sqrt(2 a d), after the reaction time.

    The commands already sent may all have full speed, whatever this one is.
    """
    allowed = np.array(velocity)
    blind = limits.speed * limits.reaction_time
    for axis, edge in enumerate((limits.workspace_x, limits.workspace_y)):
        speed = abs(allowed[axis])
        room = edge - blind - math.copysign(1.0, allowed[axis]) * position[axis]
        fastest = math.sqrt(2.0 * limits.deceleration) * math.sqrt(max(room, 0.0))
        if speed > fastest:
            allowed[axis] = math.copysign(fastest, allowed[axis])
    return allowed, 0 if np.array_equal(allowed, velocity) else WORKSPACE
