"""Where a controller that learns waits for what the last lap taught."""

import math

from push_mpc.loop import FOLLOWING, Mode, Tick


class LapGate:
    """Counts the laps that a run has completed.

    In lockstep the plant waits meanwhile, so that the tick at which a lesson takes over does not
    depend on how long learning takes: it is the first one after the end of the lap.

    Attributes:
        expected: laps that will have taught, as the server of the model counts them.
    """

    def __init__(self, duration: float, laps: int) -> None:
        """For runs of a number of laps, all of which take a duration [s]."""
        self.expected = 0
        self._lap_time, self._laps = duration / laps, laps
        self._done, self._mode = 0, Mode.IDLE

    def begin(self, taught: int) -> None:
        """A run begins when a number of laps have taught."""
        self.expected, self._done = taught, 0

    def note(self, tick: Tick) -> None:
        """Takes a tick."""
        ended = tick.mode == Mode.DONE and self._mode != Mode.DONE
        self._mode = tick.mode
        measured = tick.mode in FOLLOWING and not math.isnan(tick.exposure)
        is_last = self._done + 1 == self._laps
        if measured and not is_last and tick.reference_time >= (self._done + 1) * self._lap_time:
            ended = True
        if ended:
            self._done += 1
            self.expected += 1
