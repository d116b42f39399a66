"""Counts the equal parts of a run, for those that learn after each and those that wait for it."""

import math

PIECE = 0.05
"""Path [m] after which a run that learns within a lap has a lesson."""


class Parts:
    """Parts of a run that are over, by the time of its reference.

    Attributes:
        done: number of them.
    """

    def __init__(self, duration: float, number: float = math.inf) -> None:
        """Waits for the first of a number of parts, each with a duration [s]."""
        self.done = 0
        self._duration, self._number = duration, number

    @property
    def is_last(self) -> bool:
        """Whether the part under way ends with the run."""
        return self.done + 1 == self._number

    def ends_at(self, time: float) -> bool:
        """Whether a part other than the last is over at a time [s] of the reference.

        The tick of that time still belongs to it.
        """
        if self.is_last or time < (self.done + 1) * self._duration:
            return False
        self.done += 1
        return True
