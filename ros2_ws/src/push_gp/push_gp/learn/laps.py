"""Collects what was measured in each lap of a run, and in each short piece of it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import Array
from push_core.tracks import PIECE, Parts


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
    """What was measured in a lap, or in a piece of one.

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
    """Cuts the ticks of a run into laps, and into short pieces of path.

    The controller waits for what each of them teaches, see `LapGate` of push_mpc.
    """

    def __init__(self, lap_time: float, laps: int, speed: float) -> None:
        """Waits for the first of a number of laps, each with a duration [s], at a speed [m/s]."""
        self._laps, self._pieces = Parts(lap_time, laps), Parts(PIECE / speed)
        self._lap: list[Measured] = []
        self._piece: list[Measured] = []

    @property
    def done(self) -> int:
        """Laps that are complete."""
        return self._laps.done

    def add(self, tick: Measured) -> tuple[MeasuredLap | None, MeasuredLap | None]:
        """Takes a tick after the start of the reference.

        Returns:
            The piece that ends with it, and the lap, other than the last; None if it does not end.
        """
        self._lap.append(tick)
        self._piece.append(tick)
        piece = lap = None
        if self._pieces.ends_at(tick.time):
            # the next one begins where this one ends
            piece, self._piece = MeasuredLap.of(self._piece), [tick]
        if self._laps.ends_at(tick.time):
            lap, self._lap = MeasuredLap.of(self._lap), []
        return piece, lap

    def finish(self) -> MeasuredLap | None:
        """The last lap, when the run has come to its end; None if it is not the one under way."""
        ticks, self._lap = self._lap, []
        return MeasuredLap.of(ticks) if ticks and self._laps.is_last else None
