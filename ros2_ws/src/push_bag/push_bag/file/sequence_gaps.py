"""Counts the messages lost on a topic from sequence numbers.

Each publisher numbers its messages from 1, and the middleware does not tell the publishers of a
topic apart (`/tf` and `/diagnostics` have several). A message is taken to continue the publisher
whose last number is nearest below its own; the numbers between are lost. Where a publisher goes on
from before such a gap, the gap was the start of another publisher and is not counted.

Exact for one publisher, and zero for several without loss. Coinciding losses of several publishers
are understated: one publisher receives the number that another one lost.
"""

MOST_GAPS = 32  # latest gaps that may turn out to be the start of another publisher


class SequenceGaps:
    """Counts lost messages of one topic.

    Attributes:
        lost: messages missing between those that were added.
    """

    def __init__(self) -> None:
        self.lost = 0
        self._last: list[int] = []  # number of each publisher
        self._gaps: list[tuple[int, int]] = []  # number before the gap, and its length

    def add(self, sequence: int) -> None:
        """Counts one message by its sequence number."""
        if sequence - 1 in self._last:
            self._last[self._last.index(sequence - 1)] = sequence
            return
        last = max((each for each in self._last if each < sequence), default=0)
        gap = max((each for each in self._gaps if each[0] < sequence), default=(0, 0))
        if gap[0] > last:
            self._gaps.remove(gap)
            self.lost -= gap[1]
        elif last:
            self._last.remove(last)
        self._last.append(sequence)
        self._add_gap(max(gap[0], last), sequence)

    def _add_gap(self, before: int, after: int) -> None:
        length = after - before - 1
        if before and length:
            self.lost += length
            self._gaps.append((before, length))
            del self._gaps[:-MOST_GAPS]
