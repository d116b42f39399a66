"""Collects what was measured in each lap of a run."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import Array


@dataclass(frozen=True)
class Measured:
    """One tick in which the controller followed the reference.

    Attributes:
        time: of the reference [s].
        tracking: whether the tip was on the face.
        object_pose: (3,) measured [m, m, rad].
        tip: (2,) measured [m].
        driven: id of the lesson in use.
    """

    time: float
    tracking: bool
    object_pose: Array
    tip: Array
    driven: str


@dataclass(frozen=True)
class MeasuredLap:
    """What was measured in a lap.

    Attributes:
        time: (m,) of the reference [s].
        tracking: (m,) whether the tip was on the face.
        object_pose: (m, 3), headings without jumps of a turn.
        tip: (m, 2) [m].
        driven: (m,) ids of the lessons in use.
    """

    time: Array
    tracking: NDArray[np.bool_]
    object_pose: Array
    tip: Array
    driven: NDArray[np.str_]

    @classmethod
    def of(cls, ticks: list[Measured]) -> 'MeasuredLap':
        """The lap of its ticks, of which there is one at least."""
        poses = np.array([each.object_pose for each in ticks], dtype=float)
        poses[:, 2] = np.unwrap(poses[:, 2])
        return cls(
            np.array([each.time for each in ticks]),
            np.array([each.tracking for each in ticks]),
            poses,
            np.array([each.tip for each in ticks], dtype=float),
            np.array([each.driven for each in ticks]),
        )


class LapCollector:
    """Cuts the ticks of a run into laps.

    Attributes:
        done: laps that are complete.
    """

    def __init__(self, lap_time: float, laps: int) -> None:
        """Waits for the first lap of a number of them, each with a duration [s]."""
        self.done = 0
        self._lap_time, self._laps = lap_time, laps
        self._ticks: list[Measured] = []

    def add(self, tick: Measured) -> MeasuredLap | None:
        """Takes a tick after the start of the reference; the lap, at the end of all but the last.

        The controller waits for what such a lap teaches, see `LapGate` of push_mpc.
        """
        self._ticks.append(tick)
        is_last = self.done + 1 == self._laps
        if is_last or tick.time < (self.done + 1) * self._lap_time:
            return None
        return self._taken()

    def finish(self) -> MeasuredLap | None:
        """The last lap, when the run has come to its end; None if it is not the one under way."""
        return self._taken() if self._ticks and self.done + 1 == self._laps else None

    def _taken(self) -> MeasuredLap:
        ticks, self._ticks = self._ticks, []
        self.done += 1
        return MeasuredLap.of(ticks)
