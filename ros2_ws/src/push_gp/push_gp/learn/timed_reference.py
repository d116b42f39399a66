"""The reference that laps are measured against."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array, rotation


@dataclass(frozen=True)
class TimedReference:
    """Where the object shall be at each instant of all laps.

    Attributes:
        track: its name.
        speed: along it [m/s].
        laps: rounds of it.
        time: (n,) [s], equally spaced but for the last.
        position: (n, 2) [m] at these times.
        heading: of the object at the start [rad].
    """

    track: str
    speed: float
    laps: int
    time: Array
    position: Array
    heading: float

    @property
    def lap_time(self) -> float:
        """Duration of a lap [s]."""
        return float(self.time[-1]) / self.laps

    @property
    def period(self) -> float:
        """Time between samples [s]."""
        return float(self.time[1] - self.time[0])

    @property
    def samples(self) -> int:
        """Samples of one lap."""
        return round(self.lap_time / self.period)

    def errors(self, times: Array, positions: Array) -> Array:
        """Errors (m, 2) of positions (m, 2) [m] at times (m,) [s], in the frame of the start."""
        wanted = [np.interp(times, self.time, column) for column in self.position.T]
        return np.asarray((positions - np.column_stack(wanted)) @ rotation(self.heading))
