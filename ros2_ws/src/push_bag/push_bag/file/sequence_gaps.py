"""Messages lost on a topic, from the sequence numbers of all its publishers together.

A publisher numbers its messages from 1, and the middleware does not say whose a message is.
Numbers that follow each other form runs. A run that begins after another one ended, above its last
number, can be that one going on after a gap; of all such pairs those with the shortest gaps are
taken. A run without a predecessor is a publisher that was heard for the first time: what it sent
before is not lost, for nobody was listening yet.

With one publisher this is exact. Losses of several that coincide can be understated.
"""

import bisect
from collections.abc import Iterator
from dataclasses import dataclass

NOTHING = -2  # the last number of no run, and not before one
NEAREST = 8  # runs looked at for the one that goes on; more than publishers share a topic


@dataclass
class Run:
    """Numbers without a gap: from `first` to `last`, seen as the `born`th to `died`th message."""

    first: int
    last: int
    born: int
    died: int


class SequenceGaps:
    """Collects the runs of one topic."""

    def __init__(self) -> None:
        self._runs: list[Run] = []
        self._by_last: dict[int, list[Run]] = {}  # all but the current one
        self._current = Run(0, NOTHING, 0, 0)
        self._seen = 0

    def saw(self, sequence: int) -> None:
        """Notes one message by its publisher's number of it."""
        self._seen += 1
        current = self._current
        if sequence != current.last + 1:
            current = self._other(sequence)
        current.last, current.died = sequence, self._seen

    @property
    def lost(self) -> int:
        """Messages missing between those that were seen."""
        preceded: set[int] = set()
        continued: set[int] = set()
        lost = 0
        for gap, before, after in sorted(self._possible_gaps()):
            if before not in continued and after not in preceded:
                continued.add(before)
                preceded.add(after)
                lost += gap
        return lost

    def _possible_gaps(self) -> Iterator[tuple[int, int, int]]:
        """Length of each gap that there may be, with the indices of the runs around it."""
        by_first = sorted(range(len(self._runs)), key=lambda index: self._runs[index].first)
        firsts = [self._runs[index].first for index in by_first]
        for before, run in enumerate(self._runs):
            above = bisect.bisect_right(firsts, run.last)
            for after in by_first[above : above + NEAREST]:
                if self._runs[after].born > run.died:
                    yield self._runs[after].first - run.last - 1, before, after

    def _other(self, sequence: int) -> Run:
        """Makes another run the current one: that which this number goes on with, or a new one."""
        if self._runs:
            self._by_last.setdefault(self._current.last, []).append(self._current)
        self._current = self._continued(sequence)
        return self._current

    def _continued(self, sequence: int) -> Run:
        """The run that this number goes on with; a new one where there is none."""
        waiting = self._by_last.get(sequence - 1)
        if waiting:
            run = waiting.pop()
            if not waiting:
                del self._by_last[sequence - 1]
            return run
        run = Run(sequence, sequence, self._seen, self._seen)
        self._runs.append(run)
        return run
