"""One short straight push in a world: starts at the face, is measured once contact has settled."""

import math
from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array, to_body, wrap_angle
from push_core.physics import Slider

from push_sim.worlds.common import World

ORIGIN = np.zeros(3)


@dataclass(frozen=True)
class Instant:
    """Object and tip at one moment.

    Attributes:
        object_pose: (3,) x [m], y [m], theta [rad].
        tip_position: (2,) centre of the tip [m].
    """

    object_pose: Array
    tip_position: Array


@dataclass(frozen=True)
class PushTiming:
    """A straight push in time steps of the world.

    Attributes:
        speed: speed of the tip [m/s].
        settling: time steps of pushing before the first measurement.
        pushing: time steps from the first measurement to the second.
    """

    speed: float
    settling: int
    pushing: int


def execute_push(
    world: World,
    slider: Slider,
    timing: PushTiming,
    p_y: float,
    beta: float,
    pose: Array = ORIGIN,
    seed: int = 0,
) -> tuple[Instant, Instant]:
    """Pushes an object that was at rest.

    Args:
        world: is reset.
        slider: places the tip at the face.
        timing: speed and duration.
        p_y: contact offset [m] at which the tip starts.
        beta: direction [rad] of the tip's motion, relative to the object at the start.
        pose: (3,) start pose of the object [m, m, rad].
        seed: seed of the world's random parts.

    Returns:
        States after settling and at the end.
    """
    heading = pose[2] + math.pi / 2.0 - beta
    velocity = timing.speed * math.cos(heading), timing.speed * math.sin(heading)
    world.reset(pose, slider.tip_position(pose, p_y), seed)
    world.advance(velocity, timing.settling)
    before = Instant(world.object_pose, world.tip_position)
    world.advance(velocity, timing.pushing)
    return before, Instant(world.object_pose, world.tip_position)


def push_row(slider: Slider, before: Instant, after: Instant) -> Array:
    """A row (5,) of a push set: p_y [m], beta [rad], dx_b [m], dy_b [m], dtheta [rad]."""
    travel = after.tip_position - before.tip_position
    theta = before.object_pose[2]
    beta = math.pi / 2.0 - wrap_angle(math.atan2(travel[1], travel[0]) - theta)
    moved = to_body(before.object_pose, after.object_pose[:2])
    turned = wrap_angle(after.object_pose[2] - theta)
    p_y = slider.contact_offset(before.object_pose, before.tip_position)
    return np.array([p_y, beta, *moved, turned])
