"""The way of messages between two machines, and the offset of their clocks.

A message that is stamped when it is sent seems to be as old as its way is long, plus the offset
of the clocks. A request and its response take the way twice, by one clock. The two together tell
both, as in NTP (Mills 1991), if the way is as long in both directions.
"""

from collections import deque

_LONGEST = 16  # the newest measurements
_LEAST = 5


class LinkEstimate:
    """Takes the smallest of the newest measurements: waiting in a queue only makes them longer."""

    def __init__(self) -> None:
        """Knows nothing."""
        self._round_trips: deque[float] = deque(maxlen=_LONGEST)
        self._ages: deque[float] = deque(maxlen=_LONGEST)

    def add_round_trip(self, seconds: float) -> None:
        """Takes the time from a request to its response [s]."""
        self._round_trips.append(seconds)

    def add_age(self, seconds: float) -> None:
        """Takes how old a message was that had been stamped when it was sent [s]."""
        self._ages.append(seconds)

    @property
    def way(self) -> float:
        """Time [s] that a message takes one way; 0 while it is not known."""
        known = len(self._round_trips) >= _LEAST
        return 0.5 * min(self._round_trips) if known else 0.0

    @property
    def offset(self) -> float:
        """Time [s] by which the other clock is behind ours; 0 while it is not known."""
        known = min(len(self._round_trips), len(self._ages)) >= _LEAST
        return min(self._ages) - self.way if known else 0.0

    def fault(self, tolerance: float) -> str:
        """Which way the clocks differ by more than a tolerance [s] and what the way may hide."""
        offset = self.offset
        if abs(offset) <= tolerance + self.way:
            return ''
        return (
            f'{1e3 * abs(offset):.0f} ms {"behind" if offset > 0.0 else "ahead"} '
            f'(the way takes {1e3 * self.way:.1f} ms)'
        )
