"""The task of a planner: a track, its timing, and the limits that the plan has to keep."""

import math
from dataclasses import dataclass

from push_core.physics import Slider
from push_core.tracks import Track

INTERVAL = 0.003
"""Length of path [m] under one constant force in the optimal plan."""


@dataclass(frozen=True)
class PlanningTask:
    """A track to be planned.

    Attributes:
        track: path of the object's centre.
        speed: of the reference along it [m/s].
        slider: the pushed square.
        duration: time at which the reference ends [s].
        overrun: time [s] for which the plan goes on after its end.
        period: time between samples [s].
        speed_limits: of v_n and of |v_t| [m/s].
        headings: of the object at start and end [rad], None if free.
    """

    track: Track
    speed: float
    slider: Slider
    duration: float
    overrun: float
    period: float
    speed_limits: tuple[float, float]
    headings: tuple[float | None, float | None]

    @property
    def stride(self) -> int:
        """Samples in one interval."""
        return max(1, round(INTERVAL / self.speed / self.period))

    @property
    def intervals(self) -> int:
        """Intervals of constant force."""
        return math.ceil((self.duration + self.overrun) / (self.stride * self.period))

    @property
    def last(self) -> int:
        """The interval's start at which the reference ends."""
        return min(self.intervals, round(self.duration / (self.stride * self.period)))
