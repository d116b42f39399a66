"""Short straight pushes in the simulator, made as the measured ones were.

The tip pushes at 20 mm/s; once the contact has settled, the motion of the object over the next
0.2 s is one row. Source: Bauza, Hogan and Rodriguez 2018, section 4.
"""

import math
from types import TracebackType

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from push_core.physics import Slider

from push_sim.collect.push_design import PushDesign
from push_sim.collect.push_sampling import Aim
from push_sim.collect.short_push import Instant, push_row, short_push
from push_sim.plant import Sensor
from push_sim.settings import SimSettings
from push_sim.worlds import quick_world

_DRAWS = 100
_ANYWHERE = np.array([0.2, 0.2, math.pi])


class Collector:
    """Makes pushes one by one; each depends on seed and number alone."""

    def __init__(
        self, settings: SimSettings, slider: Slider, design: PushDesign, aim: Aim
    ) -> None:
        self._world = quick_world(settings.world, slider)
        self._sensor = Sensor(settings.sensor)
        self._slider = slider
        self._timing = design.timing
        self._aim = aim

    def __enter__(self) -> 'Collector':
        return self

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _error: BaseException | None,
        _traceback: TracebackType | None,
    ) -> None:
        self._world.close()

    def push(self, seed: int, number: int) -> Array:
        """One row (5,): p_y [m], beta [rad], dx_b [m], dy_b [m], dtheta [rad].

        The object lies anywhere on the table, which is the same in all pushes of a seed. Aims
        until the tip stays on the face.

        Raises:
            RunError: it never does.
        """
        random = np.random.default_rng([seed, number])
        self._sensor.reset(random)
        for _ in range(_DRAWS):
            p_y, beta = self._aim(number, random)
            pose = random.uniform(-_ANYWHERE, _ANYWHERE)
            made = short_push(self._world, self._slider, self._timing, p_y, beta, pose, seed)
            before, after = map(self._as_seen, made)
            if abs(self._offset(after)) <= self._slider.side / 2.0:
                return push_row(self._slider, before, after)
        raise RunError(f'push {number} left the face {_DRAWS} times: take a shorter --duration')

    def _as_seen(self, true: Instant) -> Instant:
        return Instant(self._sensor.seen(true.object_pose), true.tip_position)

    def _offset(self, seen: Instant) -> float:
        return self._slider.contact_offset(seen.object_pose, seen.tip_position)
