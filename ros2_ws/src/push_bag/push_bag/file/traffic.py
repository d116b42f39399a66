"""Counts, rate and losses of the messages of a topic."""

from array import array
from collections.abc import Hashable, Mapping
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from push_bag.file.sequence_gaps import SequenceGaps

MOST_PUBLISHERS = 10  # that send one message each on a topic such as /tf_static
Key = TypeVar('Key', bound=Hashable)


class Traffic:
    """Counts the messages of a topic in the order in which they come.

    Attributes:
        received: messages seen.
        first_ns: log time of the first message, 0 before it.
        last_ns: latest log time.
        longest_ns: longest time between two messages.
        middleware_lost: messages that the middleware reported as lost; None if unknown.
    """

    def __init__(self) -> None:
        self.received = 0
        self.first_ns = 0
        self.last_ns = 0
        self.longest_ns = 0
        self.middleware_lost: int | None = None
        self._gaps = SequenceGaps()
        self._first_number = 0
        self._numbers_differ = False
        self._most_lost: int | None = None

    def add(self, sequence: int, log_ns: int) -> None:
        """Counts one message.

        Args:
            sequence: number by its publisher, from 1; 0 where unknown.
            log_ns: when it was received [ns].
        """
        self.received += 1
        if self.received == 1:
            self.first_ns = self.last_ns = log_ns
        elif log_ns > self.last_ns:
            self.longest_ns = max(self.longest_ns, log_ns - self.last_ns)
            self.last_ns = log_ns
        if sequence:
            self._first_number = self._first_number or sequence
            self._numbers_differ |= sequence != self._first_number
            self._gaps.add(sequence)

    @classmethod
    def of(cls, numbers: NDArray[np.uint64], times: NDArray[np.uint64]) -> 'Traffic':
        """The traffic of messages (n,) in the order of their log times [ns]."""
        traffic = cls()
        traffic.received = times.size
        if times.size:
            traffic.first_ns, traffic.last_ns = int(times[0]), int(times[-1])
            traffic.longest_ns = int(np.max(np.diff(times), initial=0))
        numbered = numbers[numbers > 0]
        if numbered.size:
            traffic._first_number = int(numbered[0])
            traffic._numbers_differ = bool((numbered != numbered[0]).any())
        if (numbered[1:] != numbered[:-1] + np.uint64(1)).any():
            for number in numbered.tolist():
                traffic._gaps.add(number)
        return traffic

    def limit(self, most_lost: int) -> None:
        """States how many messages can be missing at most."""
        self._most_lost = most_lost

    def forget_numbers(self) -> None:
        """States that the sequence numbers do not tell what is missing."""
        self._first_number, self._numbers_differ = 0, False

    @property
    def numbered(self) -> bool:
        """Whether sequence numbers tell the losses: not if many messages carry the same one."""
        few = self._first_number > 0 and self.received <= MOST_PUBLISHERS
        return self._numbers_differ or few

    @property
    def lost(self) -> int:
        """Messages missing between those received; see sequence_gaps.py."""
        lost = self._gaps.lost if self.numbered else 0
        return lost if self._most_lost is None else min(lost, self._most_lost)

    @property
    def lost_is_known(self) -> bool:
        """Whether `lost` is known."""
        return self.numbered or not self.received

    @property
    def rate(self) -> float:
        """Mean messages per second between the first and the last; 0 for fewer than two."""
        span = (self.last_ns - self.first_ns) * 1e-9
        return (self.received - 1) / span if span > 0 else 0.0


class TrafficLog:
    """Collects the messages of a topic in any order, such as that of a merged file."""

    def __init__(self) -> None:
        self._times = array('Q')
        self._numbers = array('Q')

    def add(self, sequence: int, log_ns: int) -> None:
        """Adds one message; see `Traffic.add`."""
        self._times.append(log_ns)
        self._numbers.append(sequence)

    @property
    def numbers(self) -> NDArray[np.uint64]:
        """The sequence numbers (n,) in the order of the file."""
        return np.frombuffer(self._numbers, np.uint64)

    def traffic(self) -> Traffic:
        """The messages counted in the order of their log times."""
        numbers, times = self.numbers, np.frombuffer(self._times, np.uint64)
        order = np.lexsort((numbers, times))
        # some programs number from 0; more zeros mean messages without a number
        first = int(numbers.size > 1 and np.count_nonzero(numbers == 0) == 1)
        traffic = Traffic.of(numbers[order] + np.uint64(first), times[order])
        known = np.unique(numbers)
        if known.size == numbers.size:
            # of one publisher no more than the numbers that are not there
            traffic.limit(_absent(known))
        return traffic


def counted(logs: Mapping[Key, TrafficLog]) -> dict[Key, Traffic]:
    """The traffic of each topic.

    Some programs number the messages of all topics with one counter; what a topic lacks then is
    on another one.
    """
    traffic = {key: log.traffic() for key, log in logs.items()}
    lost = sum(each.lost for each in traffic.values())
    if lost and len(logs) > 1:
        numbers = np.concatenate([log.numbers for log in logs.values()])
        known = np.unique(numbers)
        if known.size == numbers.size and (absent := _absent(known)) < lost:
            for each in traffic.values():
                each.limit(0)
                if absent:
                    each.forget_numbers()
    return traffic


def lost_text(traffic: Mapping[str, Traffic]) -> str:
    """One line over all topics, such as `0 of 14130 messages lost`."""
    known = {name: each for name, each in traffic.items() if each.lost_is_known}
    unknown = {name: each for name, each in traffic.items() if name not in known}
    reported = sum(each.middleware_lost or 0 for each in traffic.values())
    ending = f'; the middleware reports {reported}' if reported else ''
    received = sum(each.received for each in unknown.values())
    if unknown and not any(each.received for each in known.values()):
        return (
            f'{received} messages; how many were lost is not known: '
            f'they have no sequence numbers{ending}'
        )
    lost = sum(each.lost for each in known.values())
    sent = lost + sum(each.received for each in known.values())
    named = ', '.join(f'{name} {each.lost}' for name, each in known.items() if each.lost)
    text = f'{lost} of {sent} messages lost' + (f': {named}' if named else '')
    if unknown:
        text += f'; not known of {received} without sequence numbers: {", ".join(unknown)}'
    return text + ending


def _absent(numbers: NDArray[np.uint64]) -> int:
    """How many numbers are missing between sorted, different numbers (n,)."""
    return int(numbers[-1] - numbers[0]) + 1 - numbers.size if numbers.size else 0
