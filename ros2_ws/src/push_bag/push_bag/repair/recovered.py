"""Counts of the messages saved from a damaged bag, and of the missing ones."""

from push_bag.file import BagContents, RawMessage, Traffic

SECOND = 1_000_000_000


class Recovered:
    """Counts the saved messages and damaged bytes, in the order of the file.

    Attributes:
        messages: number of saved messages.
        damaged_bytes: of the damaged file.
        gap_ns: sum of the times between the saved messages before and after damaged bytes [ns].
    """

    def __init__(self, contents: BagContents) -> None:
        self.messages = 0
        self.damaged_bytes = 0
        self.gap_ns = 0
        self._contents = contents
        self._traffic: dict[str, Traffic] = {}
        self._first_ns = self._last_ns = 0
        self._after_damage = False

    def add(self, topic: str, message: RawMessage) -> None:
        """Counts one saved message."""
        self._first_ns = self._first_ns or message.log_ns
        if self._after_damage and self.messages:
            self.gap_ns += max(message.log_ns - self._last_ns, 0)
        self._after_damage = False
        self._last_ns = max(self._last_ns, message.log_ns)
        self.messages += 1
        self._traffic.setdefault(topic, Traffic()).add(message.sequence, message.log_ns)

    def add_damage(self, count: int) -> None:
        """Counts damaged bytes."""
        self.damaged_bytes += count
        self._after_damage = True

    @property
    def missing(self) -> int:
        """Missing messages: from the file's statistics if intact, else from sequence numbers."""
        if self._contents.statistics is not None:
            return int(self._contents.statistics.message_count) - self.messages
        return sum(seen.lost for seen in self._traffic.values())

    @property
    def missing_ns(self) -> int:
        """Time [ns] without saved messages, as far as the bag states it."""
        stated = self._contents.statistics
        if stated is None or not self.messages:
            return self.gap_ns
        end = max(stated.message_end_time - self._last_ns, 0) if self._after_damage else 0
        begin = max(self._first_ns - stated.message_start_time, 0)
        return self.gap_ns + int(end) + int(begin)

    def facts(self) -> dict[str, str]:
        """The counts as a metadata record."""
        return {
            'messages_saved': str(self.messages),
            'messages_missing': str(self.missing),
            'seconds_missing': f'{self.missing_ns / SECOND:.3f}',
            'bytes_damaged': str(self.damaged_bytes),
        }

    def text(self) -> str:
        """The counts as lines of text."""
        span = (self._last_ns - self._first_ns) / SECOND
        lines = [
            f'{self.messages} messages of {len(self._contents.topics)} topics saved, {span:.2f} s',
            f'{self.missing} messages and {self.missing_ns / SECOND:.2f} s missing'
            f', {self.damaged_bytes} B damaged',
        ]
        if not self._contents.finished:
            lines.append(
                'the recording was cut short; messages after the last intact chunk are not counted'
            )
        return '\n'.join(lines)
