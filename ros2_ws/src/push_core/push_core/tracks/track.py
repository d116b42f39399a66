"""The interface of a track: a path of the object's centre by arc length."""

from abc import ABC, abstractmethod

import numpy as np

from push_core.geometry import Array


class Track(ABC):
    """A path by arc length s [m], 0 <= s <= length; closed tracks continue with further laps.

    Attributes:
        name: as given by the user.
        length: arc length of one lap [m].
        closed: whether it ends where it starts.
        breakpoints: arc lengths in [0, length] where the curvature jumps, in order.
    """

    name: str
    length: float
    closed: bool
    breakpoints: Array

    def at(self, s: Array) -> tuple[Array, Array, Array, Array]:
        """Position x, y [m], heading [rad, continuous] and curvature [1/m] at arc lengths (n,)."""
        s = np.asarray(s, dtype=float)
        laps = np.floor(s / self.length) if self.closed else np.zeros_like(s)
        x, y, heading, curvature = self._within(s - laps * self.length)
        return x, y, heading + laps * self._turn(), curvature

    @abstractmethod
    def _within(self, s: Array) -> tuple[Array, Array, Array, Array]:
        """As `at`, for one lap."""

    def _turn(self) -> float:
        """Change of heading [rad] over one lap."""
        heading = self._within(np.array([0.0, self.length]))[2]
        return float(heading[1] - heading[0])
