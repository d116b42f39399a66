"""The cameras: pictures with noise, bias, latency, jitter, losses and freezes.

A picture that is published at the end of a period was exposed one latency earlier, plus jitter.
With fewer pictures than periods, each is published at the end of the period in which it is due.
Each source of error draws from its own random stream, so that switching one on does not change
the others.
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array, grid_yaw

from push_sim.settings import SensorSettings

FREEZE_DURATION = 0.1
"""Duration [s] of a freeze."""


@dataclass(frozen=True)
class TrueState:
    """Where object and tip are, without noise.

    Attributes:
        object_pose: (3,) x [m], y [m], theta [rad] of the object.
        tip_position: (2,) centre of the tip [m].
    """

    object_pose: Array
    tip_position: Array


@dataclass(frozen=True)
class Observation:
    """One picture.

    Attributes:
        time: plant time of the exposure [s].
        object_pose: (3,) measured x [m], y [m], theta [rad] of the object.
        tip_position: (2,) measured centre of the tip [m].
        truth: at the exposure; for scores, not for a controller.
    """

    time: float
    object_pose: Array
    tip_position: Array
    truth: TrueState

    @property
    def shows_object(self) -> bool:
        """Whether there was a picture."""
        return not math.isnan(self.object_pose[0])


def nothing_seen(time: float) -> Observation:
    """What is published at a plant time [s] without a picture: nothing is a number."""
    pose, tip = np.full(3, math.nan), np.full(2, math.nan)
    return Observation(time, pose, tip, TrueState(pose, tip))


class Sensor:
    """Takes pictures and publishes each after its latency."""

    def __init__(self, settings: SensorSettings) -> None:
        self.change(settings)
        self.reset(np.random.default_rng())

    def change(self, settings: SensorSettings) -> None:
        """Uses other settings from the next picture on; latency and rate must be the same."""
        self._settings = settings
        self._deviation = np.array(
            [settings.position_noise, settings.position_noise, settings.angle_noise]
        )
        self._bias = np.array([0.0, 0.0, settings.angle_bias])
        self._tip_bias = np.array([settings.tip_bias_x, settings.tip_bias_y])

    def reset(self, random: np.random.Generator) -> None:
        """Drops all pictures; pose noise is drawn from `random`, the rest from its children."""
        self._noise = random
        self._delay, self._loss, self._freeze, self._tip_noise = random.spawn(4)
        self._pending: deque[Observation | None] = deque()
        self._shown = self._periods = 0
        self._begun = False
        self._frozen: Array | None = None
        self._frozen_left = 0

    def extra_delay(self, substep: float) -> int:
        """Draws the jitter of the next picture, in substeps [s] of additional latency."""
        longest = round(self._settings.jitter / substep)
        return int(self._delay.integers(longest + 1)) if longest else 0

    def expose(self, time: float, object_pose: Array, tip_position: Array) -> None:
        """Takes a picture of the true pose (3,) and tip (2,) at a plant time [s]."""
        shown = self._as_frozen(self.measured_pose(object_pose))
        truth = TrueState(object_pose, tip_position)
        picture = Observation(time, shown, self.measured_tip(tip_position), truth)
        self._pending.append(None if self._is_lost() else picture)

    def measured_pose(self, object_pose: Array) -> Array:
        """A pose (3,) with bias and new noise."""
        measured = object_pose + self._deviation * self._noise.standard_normal(3) + self._bias
        measured[2] = grid_yaw(measured[2])
        return np.asarray(measured)

    def measured_tip(self, tip_position: Array) -> Array:
        """A tip position (2,) with bias and new noise [m]."""
        noise = self._settings.tip_noise * self._tip_noise.standard_normal(2)
        return np.asarray(tip_position + noise + self._tip_bias)

    def show_first(self) -> Observation:
        """Returns the first picture, which is never lost."""
        first = self.show()
        assert first is not None
        self._begun = True
        return first

    def show(self) -> Observation | None:
        """The picture published at the end of the next period; None if there is none.

        The first call shows the picture taken before the first period.
        """
        due = self._settings.due(self._shown) == self._periods
        self._periods += 1
        self._shown += due
        return self._pending.popleft() if due else None

    def _is_lost(self) -> bool:
        rate = self._settings.dropout
        return self._begun and rate > 0.0 and self._loss.random() < rate

    def _as_frozen(self, measured: Array) -> Array:
        """The pose at which the camera is frozen, or the measured one."""
        if self._frozen_left == 0 and self._freezes():
            pictures = round(FREEZE_DURATION * self._settings.rate)
            self._frozen_left, self._frozen = pictures, measured
        if self._frozen_left == 0 or self._frozen is None:
            return measured
        self._frozen_left -= 1
        return self._frozen

    def _freezes(self) -> bool:
        rate = self._settings.freeze_rate
        return rate > 0.0 and self._freeze.random() < rate / self._settings.rate
