"""Executes short pushes in the simulator the way the measured ones were made.

The tip pushes at 20 mm/s. Once contact has settled, the motion of the object over the next 0.2 s
is one row. Source: Bauza, Hogan and Rodriguez 2018, section 4.
"""

import math

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from push_core.physics import Slider

from push_sim.collect.push_design import PushDesign
from push_sim.collect.push_sampling import Sampler
from push_sim.collect.short_push import Instant, execute_push, push_row
from push_sim.plant import Sensor
from push_sim.settings import SimSettings
from push_sim.worlds import make_coarse_world

_ATTEMPTS = 100
_POSE_RANGE = np.array([0.2, 0.2, math.pi])


class Collector:
    """Makes one push at a time; each depends only on the seed and its number."""

    def __init__(
        self, settings: SimSettings, slider: Slider, design: PushDesign, sampler: Sampler
    ) -> None:
        self._world = make_coarse_world(settings.world, slider)
        self._sensor = Sensor(settings.sensor)
        self._slider = slider
        self._timing = design.timing
        self._sampler = sampler

    def close(self) -> None:
        """Frees the resources of the world."""
        self._world.close()

    def push(self, seed: int, number: int) -> Array:
        """One row (5,): p_y [m], beta [rad], dx_b [m], dy_b [m], dtheta [rad].

        The object starts at a random pose on the table; all pushes of a seed share one table.
        Pushes after which the tip has left the face are drawn again.

        Raises:
            RunError: no push stayed on the face.
        """
        random = np.random.default_rng([seed, number])
        self._sensor.reset(random)
        for _ in range(_ATTEMPTS):
            p_y, beta = self._sampler(number, random)
            pose = random.uniform(-_POSE_RANGE, _POSE_RANGE)
            states = execute_push(self._world, self._slider, self._timing, p_y, beta, pose, seed)
            before, after = map(self._measured, states)
            if abs(self._contact_offset(after)) <= self._slider.side / 2.0:
                return push_row(self._slider, before, after)
        raise RunError(f'push {number} left the face {_ATTEMPTS} times: take a shorter --duration')

    def _measured(self, true: Instant) -> Instant:
        return Instant(
            self._sensor.measured_pose(true.object_pose),
            self._sensor.measured_tip(true.tip_position),
        )

    def _contact_offset(self, state: Instant) -> float:
        return self._slider.contact_offset(state.object_pose, state.tip_position)
