"""The cameras: exposures on a grid of 10 ms, with noise, shown some time after they were taken."""

from collections import deque
from dataclasses import dataclass

import numpy as np
from push_core.frames import Array
from push_core.quaternion import grid_yaw

from push_sim.settings import SensorSettings


@dataclass(frozen=True)
class Observation:
    """What the sensors saw.

    Attributes:
        time: plant time of the exposure [s].
        object_pose: (3,) x [m], y [m], theta [rad] of the object, with noise.
        tip_position: (2,) centre of the tip [m].
    """

    time: float
    object_pose: Array
    tip_position: Array


class Sensor:
    """Takes exposures and hands out the newest that has had the time to arrive."""

    def __init__(self, settings: SensorSettings) -> None:
        self._scale = np.array(
            [settings.position_noise, settings.position_noise, settings.angle_noise]
        )
        self._random = np.random.default_rng()
        self._under_way: deque[Observation] = deque()

    def reset(self, random: np.random.Generator) -> None:
        """Forgets all exposures; noise is drawn from this source from now on."""
        self._random = random
        self._under_way.clear()

    def expose(self, time: float, object_pose: Array, tip_position: Array) -> None:
        """Takes a picture at a plant time [s] of an object pose (3,) and a tip (2,)."""
        seen = object_pose + self._scale * self._random.standard_normal(3)
        seen[2] = grid_yaw(seen[2])
        self._under_way.append(Observation(time, seen, tip_position))

    def show(self, waiting: int) -> Observation:
        """The newest picture but `waiting`, which are still on their way."""
        while len(self._under_way) > waiting + 1:
            self._under_way.popleft()
        return self._under_way[0]
