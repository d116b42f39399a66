"""Where a controller that learns waits for what the last lap or the last piece of it taught."""

import math
from typing import NamedTuple

from push_core.tracks import PIECE, Parts

from push_mpc.loop import FOLLOWING, Mode, Tick


class Taught(NamedTuple):
    """What has taught since the start of the server: laps, and short pieces of path."""

    laps: int = 0
    pieces: int = 0

    def lacks(self, expected: 'Taught') -> bool:
        """Whether something that is expected has not taught yet."""
        return self.laps < expected.laps or self.pieces < expected.pieces


class LapGate:
    """Counts the laps that a run has completed, and the short pieces of its path.

    In lockstep the plant waits meanwhile, so that the tick at which a lesson takes over does not
    depend on how long learning takes: it is the first one after the end of the lap or the piece.

    Attributes:
        expected: what will have taught, as the server of the model counts it.
    """

    def __init__(self, duration: float, laps: int, speed: float) -> None:
        """For runs of a number of laps, all of which take a duration [s], at a speed [m/s]."""
        self._lap_time, self._number, self._speed = duration / laps, laps, speed
        self.begin(Taught())

    def begin(self, taught: Taught) -> None:
        """A run begins when some laps and pieces have taught."""
        self.expected, self._mode = taught, Mode.IDLE
        self._laps, self._pieces = Parts(self._lap_time, self._number), Parts(PIECE / self._speed)

    def note(self, tick: Tick) -> None:
        """Takes a tick."""
        ended = tick.mode == Mode.DONE and self._mode != Mode.DONE
        self._mode = tick.mode
        piece = False
        if tick.mode in FOLLOWING and tick.reference_time > 0.0 and not math.isnan(tick.exposure):
            piece = self._pieces.ends_at(tick.reference_time)
            ended = self._laps.ends_at(tick.reference_time)
        self.expected = Taught(self.expected.laps + ended, self.expected.pieces + piece)
