"""What was saved of a broken bag, and what is missing."""

from push_bag.file import BagContents, RawMessage, Traffic

SECOND = 1_000_000_000


class Recovered:
    """Counts while the whole parts of a bag are copied in the order of the file.

    Attributes:
        messages: that were saved.
        damaged_bytes: of the broken file.
        gap_ns: length of the times around damaged bytes from which nothing was saved.
    """

    def __init__(self, contents: BagContents) -> None:
        self.messages = 0
        self.damaged_bytes = 0
        self.gap_ns = 0
        self._contents = contents
        self._traffic: dict[str, Traffic] = {}
        self._first_ns = self._last_ns = 0
        self._after_damage = False

    def saw(self, topic: str, message: RawMessage) -> None:
        """Counts one message that was saved."""
        self._first_ns = self._first_ns or message.log_ns
        if self._after_damage and self.messages:
            self.gap_ns += max(message.log_ns - self._last_ns, 0)
        self._after_damage = False
        self._last_ns = max(self._last_ns, message.log_ns)
        self.messages += 1
        self._traffic.setdefault(topic, Traffic()).saw(message.sequence, message.log_ns)

    def skipped(self, count: int) -> None:
        """Counts damaged bytes."""
        self.damaged_bytes += count
        self._after_damage = True

    @property
    def missing(self) -> int:
        """Messages missing: by what the bag says it held, else by the gaps in their numbers."""
        if self._contents.statistics is not None:
            return int(self._contents.statistics.message_count) - self.messages
        return sum(seen.lost for seen in self._traffic.values())

    @property
    def missing_ns(self) -> int:
        """Time [ns] of which nothing was saved, as far as the bag tells."""
        stated = self._contents.statistics
        if stated is None or not self.messages:
            return self.gap_ns
        end = max(stated.message_end_time - self._last_ns, 0) if self._after_damage else 0
        begin = max(self._first_ns - stated.message_start_time, 0)
        return self.gap_ns + int(end) + int(begin)

    def facts(self) -> dict[str, str]:
        """The same for the bag."""
        return {
            'messages_saved': str(self.messages),
            'messages_missing': str(self.missing),
            'seconds_missing': f'{self.missing_ns / SECOND:.3f}',
            'bytes_damaged': str(self.damaged_bytes),
        }

    def text(self) -> str:
        """Lines for a person."""
        span = (self._last_ns - self._first_ns) / SECOND
        lines = [
            f'{self.messages} messages of {len(self._contents.topics)} topics saved, {span:.2f} s',
            f'{self.missing} messages and {self.missing_ns / SECOND:.2f} s missing'
            f', {self.damaged_bytes} B damaged',
        ]
        if not self._contents.finished:
            lines.append(
                'the recording was cut short: what came after the last whole chunk is not counted'
            )
        return '\n'.join(lines)
