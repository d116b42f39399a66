"""Counts of the messages saved from a damaged bag, and of the missing ones."""

from collections.abc import Sequence

from push_bag.file import BagContents, TrafficLog, counted
from push_bag.stream import RawMessage

SECOND = 1_000_000_000


class Recovered:
    """Counts the saved messages and damaged bytes, in the order of the files.

    Attributes:
        messages: number of saved messages.
        damaged_bytes: of the damaged files.
        unknown: messages that were not saved because the channel that they name is missing.
        private: records that were not saved because only the program that wrote them knows them.
    """

    def __init__(self, contents: Sequence[BagContents]) -> None:
        """Starts at zero.

        Args:
            contents: of each file of the bag.
        """
        self.messages = 0
        self.damaged_bytes = 0
        self.unknown = 0
        self.private = 0
        self._contents = contents
        self._logs: dict[str, TrafficLog] = {}
        self._pieces: list[tuple[int, int]] = []  # log times [ns] of each piece without damage
        self._after_damage = False

    def add(self, topic: str, message: RawMessage) -> None:
        """Counts one saved message."""
        if self._after_damage or not self._pieces:
            self._pieces.append((message.log_ns, message.log_ns))
        self._after_damage = False
        first, last = self._pieces[-1]
        self._pieces[-1] = min(first, message.log_ns), max(last, message.log_ns)
        self.messages += 1
        self._logs.setdefault(topic, TrafficLog()).add(message.sequence, message.log_ns)

    def add_damage(self, count: int) -> None:
        """Counts damaged bytes."""
        self.damaged_bytes += count
        self._after_damage = True

    @property
    def missing(self) -> int | None:
        """Missing messages: from the files' statistics if intact, else from sequence numbers.

        None where neither tells.
        """
        if self._stated is not None and self._stated >= self.messages:
            return self._stated - self.messages
        if not self.damaged_bytes and all(each.finished for each in self._contents):
            return self.unknown
        traffic = counted(self._logs).values()
        return (
            sum(each.lost for each in traffic) if all(e.lost_is_known for e in traffic) else None
        )

    @property
    def _stated(self) -> int | None:
        """Messages that the files state to hold; None if one does not state it."""
        stated = [each.statistics for each in self._contents]
        return None if None in stated else sum(int(each.message_count) for each in stated if each)

    @property
    def missing_ns(self) -> int:
        """Time [ns] without saved messages, as far as the bag states it."""
        if not self._pieces:
            return 0
        gaps = sum(
            # one piece comes after the other, or before it where a file is not sorted
            max(after[0] - before[1], before[0] - after[1], 0)
            for before, after in zip(self._pieces, self._pieces[1:], strict=False)
        )
        return gaps + self._missing_at_ends()

    def _missing_at_ends(self) -> int:
        stated = [each.statistics for each in self._contents]
        spans = [
            (int(each.message_start_time), int(each.message_end_time))
            for each in stated
            if each is not None and each.message_count
        ]
        if None in stated or not spans:
            return 0
        first, last = self._span
        begin = max(first - min(first for first, _ in spans), 0)
        return begin + (max(max(last for _, last in spans) - last, 0))

    @property
    def _span(self) -> tuple[int, int]:
        """Earliest and latest log time [ns] of the saved messages."""
        return (
            min((first for first, _ in self._pieces), default=0),
            max((last for _, last in self._pieces), default=0),
        )

    def facts(self) -> dict[str, str]:
        """The counts as a metadata record."""
        return {
            'messages_saved': str(self.messages),
            'messages_missing': 'unknown' if self.missing is None else str(self.missing),
            'seconds_missing': f'{self.missing_ns / SECOND:.3f}',
            'bytes_damaged': str(self.damaged_bytes),
        }

    def text(self) -> str:
        """The counts as lines of text."""
        first, last = self._span
        topics = {topic.name for each in self._contents for topic in each.topics.values()}
        seconds = (last - first) / SECOND
        lines = [f'{self.messages} messages of {len(topics)} topics saved, {seconds:.2f} s']
        if self.missing is None:
            lines.append(
                'how many messages are missing is not known: they have no sequence numbers; '
                f'{self.missing_ns / SECOND:.2f} s missing, {self.damaged_bytes} B damaged'
            )
        else:
            lines.append(
                f'{self.missing} messages and {self.missing_ns / SECOND:.2f} s missing'
                f', {self.damaged_bytes} B damaged'
            )
        return '\n'.join(lines + self._losses())

    def _losses(self) -> list[str]:
        """A line for each thing that could not be kept."""
        lines = []
        bare = sorted({name for each in self._contents for name in each.without_schema})
        if self.unknown:
            lines.append(f'{self.unknown} messages not saved: their channel is missing')
        if self.private:
            lines.append(f'{self.private} records not saved: private to another program')
        if bare:
            lines.append(f'the schema is missing of {", ".join(bare)}')
        if not all(each.finished for each in self._contents):
            lines.append(
                'the recording was cut short; messages after the last intact chunk are not counted'
            )
        return lines
