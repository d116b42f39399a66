"""Messages received and lost on one topic, counted from the publishers' sequence numbers."""

import bisect


class Traffic:
    """Counts what arrived on a topic and the gaps in what arrived.

    A publisher numbers its messages from 1. Several publishers may share a topic, and the
    middleware does not say whose a message is, so each number is matched with the publisher whose
    last number came just before it; a wrong match moves a loss from one to another and leaves the
    sum as it is. What a publisher sent before its
    first message arrived here is not lost: nobody was listening yet.

    Attributes:
        received: messages seen.
        lost: messages missing between those seen.
        numbered: whether any message carried a sequence number.
        first_ns: log time of the first message, 0 before it.
        last_ns: log time of the last message.
    """

    def __init__(self) -> None:
        self.received = 0
        self.lost = 0
        self.numbered = False
        self.first_ns = 0
        self.last_ns = 0
        self._last_numbers: list[int] = []

    def saw(self, sequence: int, log_ns: int) -> None:
        """Counts one message.

        Args:
            sequence: the publisher's number of it; 0 where unknown.
            log_ns: when it was received [ns].
        """
        self.received += 1
        self.first_ns = self.first_ns or log_ns
        self.last_ns = max(self.last_ns, log_ns)
        if sequence:
            self.numbered = True
            self._match(sequence)

    @property
    def rate(self) -> float:
        """Mean messages per second between the first and the last; 0 for fewer than two."""
        span = (self.last_ns - self.first_ns) * 1e-9
        return (self.received - 1) / span if span > 0 else 0.0

    def _match(self, sequence: int) -> None:
        below = bisect.bisect_left(self._last_numbers, sequence)
        if sequence == 1 or below == 0:
            self._last_numbers.insert(below, sequence)
            return
        self.lost += sequence - self._last_numbers[below - 1] - 1
        self._last_numbers[below - 1] = sequence


def lost_text(traffic: dict[str, Traffic]) -> str:
    """One line over all topics, such as `0 of 14130 messages lost`."""
    lost = sum(each.lost for each in traffic.values())
    sent = lost + sum(each.received for each in traffic.values())
    return f'{lost} of {sent} messages lost'
