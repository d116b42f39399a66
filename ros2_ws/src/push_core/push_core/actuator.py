"""The robot between command and tip: dead time, first-order lag, speed and acceleration limits.

The measured runs of the real cell lag by 110 ms; 60 ms of dead time and a 50 ms lag reproduce them
to 0.2 mm rms. The plant and the controller's predictor use this same class.
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np

from push_core.frames import Array
from push_core.settings import setting, validate

_TIME_TOLERANCE = 1e-9


@dataclass(frozen=True)
class ActuatorSettings:
    """How the tip follows its velocity commands."""

    dead_time: float = setting(
        0.06, 'time until a command begins to act', unit='s', low=0.0, high=1.0
    )
    lag: float = setting(0.05, 'time constant of the first-order lag', unit='s', low=0.0, high=1.0)
    speed_limit: float = setting(0.25, 'largest speed of the tip', unit='m/s', low=1e-3, high=2.0)
    acceleration_limit: float = setting(
        5.0, 'largest acceleration of the tip', unit='m/s^2', low=0.1, high=100.0
    )
    deceleration_limit: float = setting(
        2.0, 'deceleration of a stop by the driver', unit='m/s^2', low=0.1, high=100.0
    )

    def __post_init__(self) -> None:
        validate(self)


ACTUATORS = {
    'irb120': ActuatorSettings(),
    'ideal': ActuatorSettings(dead_time=0.0, lag=0.0, acceleration_limit=100.0),
}


class Actuator:
    """Turns timed velocity commands into the velocity of the tip."""

    def __init__(self, settings: ActuatorSettings) -> None:
        self.settings = settings
        self._queue: deque[tuple[float, Array]] = deque()
        self._target: Array = np.zeros(2)
        self.velocity: Array = np.zeros(2)

    def reset(self) -> None:
        """At rest, no command under way."""
        self._queue.clear()
        self._target = np.zeros(2)
        self.velocity = np.zeros(2)

    def command(self, velocity: Array, arrival: float) -> None:
        """Accepts a velocity (2,) [m/s] that arrived at a time [s], not before the last one."""
        self._queue.append(
            (arrival + self.settings.dead_time, _shortened(velocity, self.settings.speed_limit))
        )

    def advance(self, now: float, duration: float) -> Array:
        """Moves on by `duration` [s] from `now` [s]; returns the mean velocity (2,) over it."""
        self._take_commands(now)
        start = self.velocity
        decay = math.exp(-duration / self.settings.lag) if self.settings.lag > 0.0 else 0.0
        change = (self._target - start) * (1.0 - decay)
        allowed = _shortened(change, self.settings.acceleration_limit * duration)
        self.velocity = start + allowed
        if allowed is not change:
            return 0.5 * (start + self.velocity)
        return self._target - change * (self.settings.lag / duration)

    def brake(self, duration: float) -> Array:
        """Drops all commands and slows down for `duration` [s]; returns the mean velocity (2,)."""
        self._queue.clear()
        self._target = np.zeros(2)
        start = self.velocity
        self.velocity = start - _shortened(start, self.settings.deceleration_limit * duration)
        return 0.5 * (start + self.velocity)

    def copy_state(self, other: 'Actuator') -> None:
        """Takes over velocity, target and queue of another actuator."""
        self.velocity = other.velocity
        self._target = other._target
        self._queue = other._queue.copy()

    def _take_commands(self, now: float) -> None:
        while self._queue and self._queue[0][0] <= now + _TIME_TOLERANCE:
            self._target = self._queue.popleft()[1]


def _shortened(vector: Array, length: float) -> Array:
    """The vector (2,) itself, or one of the same direction and the given length."""
    norm = math.hypot(vector[0], vector[1])
    return vector if norm <= length else vector * (length / norm)
