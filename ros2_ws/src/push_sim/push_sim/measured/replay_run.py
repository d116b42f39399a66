"""The windows of a robot run, made again in the simulator: the tip as sensed, the object free."""

from contextlib import closing

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

from push_sim.measured.run_windows import INTERVAL, Windows
from push_sim.settings import WorldSettings
from push_sim.worlds import SUBSTEP, quick_world
from push_sim.worlds.common import World

_SUBSTEPS = round(INTERVAL / SUBSTEP)


def replay_run(settings: WorldSettings, slider: Slider, cut: Windows) -> Array:
    """End poses (n, 3) [m, m, rad] of the object, each from its measured start.

    Args:
        settings: of the world.
        slider: what is pushed.
        cut: the windows.
    """
    with closing(quick_world(settings, slider)) as world:
        ends = [_end(world, *row) for row in zip(cut.start, cut.tip, strict=True)]
    return np.reshape(ends, (-1, 3))


def _end(world: World, start: Array, tip: Array) -> Array:
    world.reset(start, tip[0])
    for x, y in (np.diff(tip, axis=0) / INTERVAL).tolist():
        world.advance((x, y), _SUBSTEPS)
    return world.object_pose
