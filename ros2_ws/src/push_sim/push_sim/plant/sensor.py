"""The cameras: exposures some time ahead of each period's end, with noise, gaps and standstills.

What is shown at the end of period m was exposed one latency earlier, and a little more where
there is jitter. Each source of trouble draws from a stream of its own, so that switching one on
leaves the others as they are.
"""

from collections import deque
from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array, grid_yaw

from push_sim.settings import PERIOD, SensorSettings

FREEZE_DURATION = 0.1
"""How long [s] the pose stands still when it does."""


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
    """Takes exposures and hands out each at its time."""

    def __init__(self, settings: SensorSettings) -> None:
        self._settings = settings
        self._scale = np.array(
            [settings.position_noise, settings.position_noise, settings.angle_noise]
        )
        self.reset(np.random.default_rng())

    def reset(self, random: np.random.Generator) -> None:
        """Forgets all exposures; noise is drawn from this source, the rest from its children."""
        self._noise = random
        self._delay, self._loss, self._freeze = random.spawn(3)
        self._under_way: deque[Observation | None] = deque()
        self._begun = False
        self._frozen: Array | None = None
        self._frozen_left = 0

    def extra_delay(self, substep: float) -> int:
        """Draws how many substeps [s] earlier than the latency says the next picture is taken."""
        longest = round(self._settings.jitter / substep)
        return int(self._delay.integers(longest + 1)) if longest else 0

    def expose(self, time: float, object_pose: Array, tip_position: Array) -> None:
        """Takes the next picture at a plant time [s] of an object pose (3,) and a tip (2,)."""
        shown = self._as_frozen(self.seen(object_pose))
        picture = Observation(time, shown, tip_position)
        self._under_way.append(None if self._is_lost() else picture)

    def seen(self, object_pose: Array) -> Array:
        """A pose (3,) as one picture has it, with noise."""
        seen = object_pose + self._scale * self._noise.standard_normal(3)
        seen[2] = grid_yaw(seen[2])
        return np.asarray(seen)

    def show_first(self) -> Observation:
        """Hands out the first picture, which never gets lost."""
        first = self.show()
        assert first is not None
        self._begun = True
        return first

    def show(self) -> Observation | None:
        """Hands out the oldest picture under way; None where it got lost."""
        return self._under_way.popleft()

    def _is_lost(self) -> bool:
        rate = self._settings.dropout
        return self._begun and rate > 0.0 and self._loss.random() < rate

    def _as_frozen(self, seen: Array) -> Array:
        """The pose that is shown instead: the one at which it stands still, or what is seen."""
        if self._frozen_left == 0 and self._freezes():
            self._frozen_left, self._frozen = round(FREEZE_DURATION / PERIOD), seen
        if self._frozen_left == 0 or self._frozen is None:
            return seen
        self._frozen_left -= 1
        return self._frozen

    def _freezes(self) -> bool:
        rate = self._settings.freeze_rate
        return rate > 0.0 and self._freeze.random() < rate * PERIOD
