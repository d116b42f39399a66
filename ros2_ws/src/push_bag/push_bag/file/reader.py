"""Reads the messages of a bag, also of one that was cut short."""

from collections.abc import Collection, Iterator
from pathlib import Path
from typing import IO, Any, NamedTuple

from mcap.opcode import Opcode
from push_core.common import InputError
from rclpy.serialization import deserialize_message

from push_bag.file.bag_contents import BagContents
from push_bag.file.mcap_stream import (
    CutShortError,
    DamagedError,
    RawMessage,
    chunk_data,
    chunk_records,
    message,
    top_records,
)
from push_bag.file.message_types import message_class
from push_bag.file.topic_registry import Topic


class Record(NamedTuple):
    """One serialized message of a bag, with its times [ns] and sequence number."""

    topic: Topic
    data: bytes
    log_ns: int
    publish_ns: int
    sequence: int

    def message(self) -> Any:
        """Deserializes the message.

        Raises:
            InputError: the type is not installed, or the bytes are not of that type.
        """
        kind = message_class(self.topic.type_name)
        try:
            return deserialize_message(self.data, kind)
        except (RuntimeError, ValueError, MemoryError):
            raise InputError(
                f'a message on {self.topic.name} is not a {self.topic.type_name}'
            ) from None


class BagReader:
    """One bag; each call of `records` reads it from the beginning.

    Attributes:
        path: the MCAP file.
        contents: what the bag states about itself. Facts and attachments are complete after the
            first message, topics and `finished` after the last one.
    """

    def __init__(self, path: Path) -> None:
        """Finds the MCAP file; opens it only when it is read.

        Args:
            path: a run folder or an MCAP file.

        Raises:
            InputError: there is no bag.
        """
        self.path = bag_file(path)
        self.contents = BagContents()

    @property
    def topics(self) -> dict[str, Topic]:
        """The topics by name."""
        return {topic.name: topic for topic in self.contents.topics.values()}

    @property
    def facts(self) -> dict[str, str]:
        """The facts of the run."""
        return self.contents.facts

    @property
    def attachments(self) -> dict[str, bytes]:
        """Attached files by name."""
        return self.contents.attachments

    @property
    def finished(self) -> bool:
        """Whether the file has its footer; False if the recording was cut short."""
        return self.contents.finished

    def records(self, names: Collection[str] | None = None) -> Iterator[Record]:
        """All messages in the order of the file; holds one chunk in memory at a time.

        Args:
            names: full names of the topics to read; None for all.

        Raises:
            InputError: the file is empty, not a bag, or damaged before its end.
        """
        topics = self.contents.topics
        with self.path.open('rb') as stream:
            for raw in self._unpacked(stream):
                topic = topics.get(raw.channel)
                if topic is None:
                    raise InputError(f'{self.path} is damaged: a message has an unknown topic')
                if names is None or topic.name in names:
                    yield Record(topic, raw.data, raw.log_ns, raw.publish_ns, raw.sequence)

    def _unpacked(self, stream: IO[bytes]) -> Iterator[RawMessage]:
        try:
            for record in top_records(stream, self.path.stat().st_size):
                if record.opcode == Opcode.CHUNK:
                    yield from self._messages(record.body)
                elif record.opcode == Opcode.MESSAGE:
                    yield message(record.body)
                else:
                    self.contents.add(record)
        except CutShortError:
            if not self.contents.topics:
                raise InputError(f'{self.path} ends before its first message') from None
        except DamagedError as error:
            raise InputError(
                f'{self.path} is no bag or is damaged: {error}; '
                '`push_bag recover` saves the intact part'
            ) from None

    def _messages(self, chunk: bytes) -> Iterator[RawMessage]:
        for record in chunk_records(chunk_data(chunk)):
            if isinstance(record, RawMessage):
                yield record
            else:
                self.contents.add(record)


def bag_file(path: Path) -> Path:
    """The MCAP file of a run.

    Args:
        path: run folder or MCAP file.

    Raises:
        InputError: there is none, or more than one.
    """
    if path.is_file():
        return path
    if not path.is_dir():
        raise InputError(f'{path} does not exist; name a run folder or an MCAP file')
    bags = sorted(each for each in path.iterdir() if each.suffix == '.mcap')
    if not bags:
        raise InputError(f'{path} holds no MCAP file; name a run folder or an MCAP file')
    if len(bags) > 1:
        raise InputError(f'{path} holds {len(bags)} MCAP files; name the one to read')
    return bags[0]
