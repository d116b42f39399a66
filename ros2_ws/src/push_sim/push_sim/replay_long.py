"""Measured long pushes, made again in the simulator."""

from contextlib import closing

import numpy as np
from push_core.frames import Array
from push_core.slider import Slider

from push_sim.quick_world import SPEED, SUBSTEP, quick_world
from push_sim.settings import WorldSettings
from push_sim.world import World

RETREAT = 0.002
"""The tip sets out this far [m] before its measured start: some of those lie inside the square,
by up to 0.4 mm."""


def replay_long(
    settings: WorldSettings, slider: Slider, start: Array, tip_start: Array, tip_end: Array
) -> Array:
    """End poses (n, 3) [m, m, rad] of the object where the tip moves as it was measured.

    Args:
        settings: of the world.
        slider: what is pushed.
        start: (n, 3) object poses before [m, m, rad].
        tip_start: (n, 2) tip positions before [m].
        tip_end: (n, 2) tip positions after [m].
    """
    with closing(quick_world(settings, slider)) as world:
        ends = [_end(world, *row) for row in zip(start, tip_start, tip_end, strict=True)]
    return np.reshape(ends, (-1, 3))


def set_out(tip_start: Array, tip_end: Array) -> Array:
    """Points (..., 2) [m] from which the tips set out, a little before their starts (..., 2)."""
    travel = tip_end - tip_start
    length = np.linalg.norm(travel, axis=-1, keepdims=True)
    return np.asarray(tip_start - RETREAT / length * travel)


def _end(world: World, start: Array, tip_start: Array, tip_end: Array) -> Array:
    begin = set_out(tip_start, tip_end)
    steps = max(1, round(float(np.linalg.norm(tip_end - begin)) / (SPEED * SUBSTEP)))
    x, y = ((tip_end - begin) / (steps * SUBSTEP)).tolist()
    world.reset(start, begin)
    world.advance((x, y), steps)
    return world.object_pose
