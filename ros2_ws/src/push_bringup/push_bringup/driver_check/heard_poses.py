"""What a driver published while it was listened to, as arrays."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import Array

Times = NDArray[np.int64]


@dataclass(frozen=True)
class HeardPoses:
    """The messages of one pose topic.

    Attributes:
        topic: its name.
        stamp: in the headers [ns]; (n,).
        arrival: by the clock of the listener [ns]; (n,).
        position: [m]; (n, 3).
        quaternion: x, y, z, w; (n, 4).
        frames: frame_id of each.
    """

    topic: str
    stamp: Times
    arrival: Times
    position: Array
    quaternion: Array
    frames: Sequence[str]

    def __len__(self) -> int:
        return len(self.stamp)

    @property
    def age(self) -> Array:
        """Time from stamp to arrival [s]; (n,)."""
        return np.asarray(1e-9 * (self.arrival - self.stamp))

    def between(self, start: int, end: int) -> Array:
        """Positions x, y (m, 2) [m] with stamps from `start` to `end` [ns]."""
        chosen = (self.stamp >= start) & (self.stamp <= end)
        return np.asarray(self.position[chosen, :2])


@dataclass(frozen=True)
class TipMotion:
    """A short push of the tip through the air, forth and back, and what was heard meanwhile.

    Each lasts until the tip must be at rest again. Times are of the listener's clock [ns].

    Attributes:
        velocity: commanded forth (2,) [m/s].
        duration: of commands with that velocity [s].
        start: first command forth.
        stopped: first command of zero after it.
        back: first command back.
        silent: last command back; none follows.
        end: when listening ended.
        tip: poses of the tip.
    """

    velocity: Array
    duration: float
    start: int
    stopped: int
    back: int
    silent: int
    end: int
    tip: HeardPoses
