"""The robot's driver: limits and executes velocity commands, and brakes when none arrive."""

import math
from collections import Counter, deque

import numpy as np
from push_core.geometry import Array
from push_core.physics import (
    LIMIT_NAMES,
    NOT_FINITE,
    Actuator,
    ActuatorSettings,
    Pair,
    SafetyLimits,
    limit,
)


class Driver:
    """Feeds the actuator; its watchdog uses the plant's clock, not the stamps of the commands.

    Attributes:
        limited: commands that each limit changed, by the names of `LIMIT_NAMES`, since the start.
    """

    def __init__(
        self,
        settings: ActuatorSettings,
        timeout: float,
        loss: float = 0.0,
        limits: SafetyLimits | None = None,
    ) -> None:
        """Starts at rest.

        Args:
            settings: actuator of the robot.
            timeout: time without a command after which it brakes [s].
            loss: fraction of commands that are lost before they arrive.
            limits: of a command, whoever sends it; the actuator limits the acceleration.
        """
        self.limited: Counter[str] = Counter()
        self._actuator = Actuator(settings)
        self._limits = limits or SafetyLimits()
        self.change(timeout, loss)
        self.reset(np.random.default_rng())

    def change(self, timeout: float, loss: float) -> None:
        """Uses another timeout [s] and fraction of lost commands from now on."""
        self._timeout = timeout
        self._loss = loss

    def reset(self, random: np.random.Generator) -> None:
        """Puts the tip at rest and drops all commands; losses are drawn from `random`."""
        self._random = random
        self._actuator.reset()
        self._inbox: deque[tuple[float, Array]] = deque()
        self._last_arrival = -math.inf
        self._braking = True

    @property
    def velocity(self) -> Array:
        """Velocity (2,) of the tip [m/s]."""
        return self._actuator.velocity

    @property
    def braking(self) -> bool:
        """Whether the watchdog is braking the tip or holding it at rest."""
        return self._braking

    def command(self, velocity: Array, arrival: float, position: Array) -> None:
        """Takes a velocity (2,) [m/s] that arrives at a time [s], not before the last one.

        A velocity that is not finite is ignored; the watchdog then stops the tip, which is at
        `position` (2,) [m].
        """
        if self._is_lost():
            return
        limited, bits = limit(velocity, velocity, position, self._limits, 0.0)
        if bits:
            self.limited.update(name for bit, name in LIMIT_NAMES.items() if bits & bit)
        if not bits & NOT_FINITE:
            self._inbox.append((arrival, np.array(limited, dtype=float)))

    def _is_lost(self) -> bool:
        return self._loss > 0.0 and self._random.random() < self._loss

    def advance(self, now: float, duration: float) -> Pair:
        """Advances from `now` by `duration` [s]; returns the mean velocity of the tip [m/s]."""
        self._open_inbox(now)
        self._braking = now - self._last_arrival > self._timeout
        if self._braking:
            # a stop has neither dead time nor lag
            return self._actuator.brake(duration)
        return self._actuator.advance(now, duration)

    def _open_inbox(self, now: float) -> None:
        while self._inbox and self._inbox[0][0] <= now:
            self._last_arrival, velocity = self._inbox.popleft()
            self._actuator.command(velocity, self._last_arrival)
