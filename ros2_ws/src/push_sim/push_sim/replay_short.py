"""Measured short pushes, made again in the simulator."""

from contextlib import closing

import numpy as np
from push_core.frames import Array
from push_core.slider import Slider

from push_sim.quick_world import SPEED, SUBSTEP, quick_world
from push_sim.settings import WorldSettings
from push_sim.short_push import PushTiming, push_row, short_push
from push_sim.world import World

_SETTLING = 4


def replay_short(settings: WorldSettings, slider: Slider, inputs: Array, distance: float) -> Array:
    """The displacements that the simulator gives the object.

    Args:
        settings: of the world.
        slider: what is pushed.
        inputs: (n, 2) contact offset p_y [m] and direction beta [rad] of each push once its
            contact has settled, as they were measured.
        distance: travel of the tip in each push [m].

    Returns:
        (n, 3) dx_b [m], dy_b [m], dtheta [rad] in the body frame at the start of each push.
    """
    timing = PushTiming(SPEED, _SETTLING, round(distance / SPEED / SUBSTEP))
    with closing(quick_world(settings, slider)) as world:
        rows = [_settled_push(world, slider, timing, row) for row in inputs]
    return np.reshape(rows, (-1, 5))[:, 2:]


def _settled_push(world: World, slider: Slider, timing: PushTiming, wanted: Array) -> Array:
    """The row of a push that is at the wanted [p_y, beta] after settling.

    While it settles, the tip slides and the object turns by a little; the second attempt sets
    out by as much earlier.
    """
    first = push_row(slider, *short_push(world, slider, timing, *wanted))
    aim = 2.0 * wanted - first[:2]
    return push_row(slider, *short_push(world, slider, timing, *aim))
