"""Counts, rate and losses of the messages of a topic."""

from collections.abc import Mapping

from push_bag.file.sequence_gaps import SequenceGaps


class Traffic:
    """Counts the messages of a topic.

    Attributes:
        received: messages seen.
        numbered: whether any message carried a sequence number.
        first_ns: log time of the first message, 0 before it.
        last_ns: log time of the last message.
        longest_ns: longest time between two messages.
        middleware_lost: messages that the middleware reported as lost; None if unknown.
    """

    def __init__(self) -> None:
        self.received = 0
        self.numbered = False
        self.first_ns = 0
        self.last_ns = 0
        self.longest_ns = 0
        self.middleware_lost: int | None = None
        self._gaps = SequenceGaps()

    def add(self, sequence: int, log_ns: int) -> None:
        """Counts one message.

        Args:
            sequence: number by its publisher, from 1; 0 where unknown.
            log_ns: when it was received [ns].
        """
        self.received += 1
        if self.first_ns == 0:
            self.first_ns = self.last_ns = log_ns
        elif log_ns > self.last_ns:
            self.longest_ns = max(self.longest_ns, log_ns - self.last_ns)
            self.last_ns = log_ns
        if sequence:
            self.numbered = True
            self._gaps.add(sequence)

    @property
    def lost(self) -> int:
        """Messages missing between those received; see sequence_gaps.py."""
        return self._gaps.lost

    @property
    def rate(self) -> float:
        """Mean messages per second between the first and the last; 0 for fewer than two."""
        span = (self.last_ns - self.first_ns) * 1e-9
        return (self.received - 1) / span if span > 0 else 0.0


def lost_text(traffic: Mapping[str, Traffic]) -> str:
    """One line over all topics, such as `0 of 14130 messages lost`."""
    lost = sum(each.lost for each in traffic.values())
    sent = lost + sum(each.received for each in traffic.values())
    named = ', '.join(f'{name} {each.lost}' for name, each in traffic.items() if each.lost)
    reported = sum(each.middleware_lost or 0 for each in traffic.values())
    text = f'{lost} of {sent} messages lost' + (f': {named}' if named else '')
    return text + (f'; the middleware reports {reported}' if reported else '')
