"""Model of the robot: dead time, first-order lag, limits of speed and acceleration.

The real robot lags by 110 ms. 60 ms of dead time and 49 ms of lag reproduce its unperturbed
measured run to 0.2 mm rms (`push_sim calibrate`). The plant and the controller's predictor both
use this class.
"""

import math
from collections import deque
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from push_core.common import setting, validate
from push_core.geometry import Array

Pair: TypeAlias = tuple[float, float]
_TIME_TOLERANCE = 1e-9


@dataclass(frozen=True)
class ActuatorSettings:
    """Parameters of the response of the tip to velocity commands."""

    dead_time: float = setting(
        0.06, 'time until a command begins to act', unit='s', low=0.0, high=1.0
    )
    lag: float = setting(
        0.049, 'time constant of the first-order lag', unit='s', low=0.0, high=1.0
    )
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
    'harsh': ActuatorSettings(),
    'webcam': ActuatorSettings(),
    'ideal': ActuatorSettings(dead_time=0.0, lag=0.0, acceleration_limit=100.0),
}


class Actuator:
    """Computes the velocity of the tip from timed velocity commands.

    It uses plain numbers, several times faster than arrays of two: the plant advances it 1000
    times a second, the predictor a dozen times a tick.
    """

    def __init__(self, settings: ActuatorSettings) -> None:
        self.settings = settings
        self._queue: deque[tuple[float, Pair]] = deque()
        self._target: Pair = (0.0, 0.0)
        self._velocity: Pair = (0.0, 0.0)

    @property
    def velocity(self) -> Array:
        """Velocity (2,) of the tip [m/s]."""
        return np.array(self._velocity)

    def reset(self) -> None:
        """Puts the tip at rest and drops all commands."""
        self._queue.clear()
        self._target = self._velocity = (0.0, 0.0)

    def command(self, velocity: Array, arrival: float) -> None:
        """Adds a command (2,) [m/s] that arrived at a time [s], not before the previous one."""
        target = (float(velocity[0]), float(velocity[1]))
        acts_at = arrival + self.settings.dead_time
        self._queue.append((acts_at, _shortened(target, self.settings.speed_limit)))

    def advance(self, now: float, duration: float) -> Pair:
        """Advances from `now` [s] by `duration` [s]; returns the mean velocity [m/s].

        A command that begins to act within the duration does so at its exact time.
        """
        moved_x = moved_y = 0.0
        start, end = now, now + duration
        while self._queue and self._queue[0][0] < end - _TIME_TOLERANCE:
            acts_at, target = self._queue.popleft()
            if acts_at > start + _TIME_TOLERANCE:
                x, y = self._approach(acts_at - start)
                moved_x, moved_y = moved_x + x * (acts_at - start), moved_y + y * (acts_at - start)
                start = acts_at
            self._target = target
        if start == now:
            return self._approach(duration)
        x, y = self._approach(end - start)
        return (moved_x + x * (end - start)) / duration, (moved_y + y * (end - start)) / duration

    def brake(self, duration: float) -> Pair:
        """Drops all commands and brakes for `duration` [s]; returns the mean velocity [m/s]."""
        self._queue.clear()
        self._target = (0.0, 0.0)
        x, y = self._velocity
        lost = _shortened(self._velocity, self.settings.deceleration_limit * duration)
        self._velocity = (x - lost[0], y - lost[1])
        return x - 0.5 * lost[0], y - 0.5 * lost[1]

    def copy_state(self, other: 'Actuator') -> None:
        """Copies velocity, target and queue of another actuator."""
        self._velocity = other._velocity
        self._target = other._target
        self._queue = other._queue.copy()

    def _approach(self, duration: float) -> Pair:
        """Approaches the target velocity for `duration` [s]; returns the mean velocity [m/s]."""
        (x, y), (target_x, target_y) = self._velocity, self._target
        lag = self.settings.lag
        reached = 1.0 - math.exp(-duration / lag) if lag > 0.0 else 1.0
        change = ((target_x - x) * reached, (target_y - y) * reached)
        allowed = _shortened(change, self.settings.acceleration_limit * duration)
        self._velocity = (x + allowed[0], y + allowed[1])
        if allowed is not change:
            return x + 0.5 * allowed[0], y + 0.5 * allowed[1]
        ratio = lag / duration
        return target_x - ratio * change[0], target_y - ratio * change[1]


def _shortened(vector: Pair, length: float) -> Pair:
    """The vector, scaled down to a length if it is longer."""
    norm = math.hypot(*vector)
    if norm <= length:
        return vector
    return vector[0] * (length / norm), vector[1] * (length / norm)
