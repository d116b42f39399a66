"""Measured short pushes, made again in the simulator.

They were measured from settled contact on. In the simulator the contact settles within the first
time step: pushing for up to 0.1 s before changes the mean NMSE by less than 0.001.
"""

from contextlib import closing

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

from push_sim.collect import PushTiming, push_row, short_push
from push_sim.settings import WorldSettings
from push_sim.worlds import SPEED, SUBSTEP, quick_world


def replay_short(settings: WorldSettings, slider: Slider, inputs: Array, distance: float) -> Array:
    """The displacements that the simulator gives the object.

    Args:
        settings: of the world.
        slider: what is pushed.
        inputs: (n, 2) contact offset p_y [m] and direction beta [rad] at the start of each push.
        distance: travel of the tip in each push [m].

    Returns:
        (n, 3) dx_b [m], dy_b [m], dtheta [rad] in the body frame at the start of each push.
    """
    steps = max(1, round(distance / (SPEED * SUBSTEP)))
    timing = PushTiming(distance / (steps * SUBSTEP), 0, steps)
    with closing(quick_world(settings, slider)) as world:
        rows = [push_row(slider, *short_push(world, slider, timing, *row)) for row in inputs]
    return np.reshape(rows, (-1, 5))[:, 2:]
