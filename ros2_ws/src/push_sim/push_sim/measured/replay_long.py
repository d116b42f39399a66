"""Measured long pushes, made again in the simulator.

The tip sets out 2 mm before its measured start: some of those lie inside the square, by up to
0.4 mm.
"""

from contextlib import closing

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

from push_sim.settings import WorldSettings
from push_sim.worlds import SPEED, SUBSTEP, quick_world
from push_sim.worlds.common import World

_RETREAT = 0.002


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


def _end(world: World, start: Array, tip_start: Array, tip_end: Array) -> Array:
    travel = tip_end - tip_start
    begin = tip_start - _RETREAT * travel / np.linalg.norm(travel)
    steps = max(1, round(float(np.linalg.norm(tip_end - begin)) / (SPEED * SUBSTEP)))
    x, y = ((tip_end - begin) / (steps * SUBSTEP)).tolist()
    world.reset(start, begin)
    world.advance((x, y), steps)
    return world.object_pose
