"""Reads the messages of a bag, also of one that was cut short."""

import contextlib
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any, NamedTuple

from mcap.opcode import Opcode
from push_core.common import InputError
from rclpy.serialization import deserialize_message

from push_bag.file.bag_contents import BagContents
from push_bag.file.bag_files import bag_files
from push_bag.file.cdr_columns import COMPRESSED, is_compressed
from push_bag.file.message_types import message_class
from push_bag.file.topic_registry import Topic
from push_bag.stream import (
    Attachment,
    ByteFile,
    CutShortError,
    DamagedError,
    RawMessage,
    RawRecord,
    attachment,
    chunk,
    chunk_records,
    message,
    raw_record,
    spans,
)


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
        if is_compressed(self.data):
            raise InputError(f'{self.topic.name}: {COMPRESSED}')
        try:
            return deserialize_message(self.data, kind)
        except (RuntimeError, ValueError, MemoryError):
            raise InputError(
                f'a message on {self.topic.name} is not a {self.topic.type_name}'
            ) from None


class BagReader:
    """One bag of one or more files; each call of `records` reads it from the beginning.

    Attributes:
        path: the MCAP file, or the folder of a bag that was split into several.
        paths: the MCAP files in their order.
    """

    def __init__(self, path: Path) -> None:
        """Finds the MCAP files; opens them only when they are read.

        Args:
            path: a run folder or an MCAP file.

        Raises:
            InputError: there is no bag.
        """
        self.paths = bag_files(path)
        self.path = self.paths[0] if len(self.paths) == 1 else path
        self._contents: dict[Path, BagContents] = {}

    @property
    def all_topics(self) -> list[Topic]:
        """The topics of all channels; known after the last message."""
        return [topic for each in self._contents.values() for topic in each.topics.values()]

    @property
    def topics(self) -> dict[str, Topic]:
        """The topics by name; of several types of one topic the last one."""
        return {topic.name: topic for topic in self.all_topics}

    @property
    def facts(self) -> dict[str, str]:
        """The facts of the run; known after the first message."""
        facts: dict[str, str] = {}
        for each in self._contents.values():
            facts = {**each.facts, **facts}
        return facts

    @property
    def attached(self) -> list[Attachment]:
        """The attached files, not read yet."""
        return [each for part in self._contents.values() for each in part.attachments]

    @property
    def attachments(self) -> dict[str, bytes]:
        """The data of the attached files by name."""
        return {each.name: each.data for each in self.attached}

    @property
    def middleware_lost(self) -> dict[str, int]:
        """Messages by topic that the middleware reported as lost."""
        lost: dict[str, int] = {}
        for each in self._contents.values():
            for topic, count in each.middleware_lost.items():
                lost[topic] = lost.get(topic, 0) + count
        return lost

    @property
    def finished(self) -> bool:
        """Whether every file has its footer; False if the recording was cut short."""
        contents = self._contents.values()
        return len(contents) == len(self.paths) and all(each.finished for each in contents)

    def records(self, names: Collection[str] | None = None) -> Iterator[Record]:
        """All messages in the order of the files; holds a few MB in memory at a time.

        Args:
            names: full names of the topics to read; None for all.

        Raises:
            InputError: a file is empty, not a bag, or damaged before its end.
        """
        for path in self.paths:
            contents = self._contents[path] = BagContents()
            for raw in _messages(path, contents):
                topic = contents.topics.get(raw.channel)
                if topic is None:
                    raise InputError(f'{path} is damaged: a message has an unknown topic')
                if names is None or topic.name in names:
                    yield Record(topic, raw.data, raw.log_ns, raw.publish_ns, raw.sequence)
        if not self.finished and not self.all_topics:
            raise InputError(f'{self.path} ends before its first message')


def _messages(path: Path, contents: BagContents) -> Iterator[RawMessage]:
    """The messages of a file; all else goes to its contents."""
    try:
        with ByteFile(path) as file, contextlib.suppress(CutShortError):
            for record in _records(file, contents):
                if isinstance(record, RawMessage):
                    yield record
                else:
                    contents.add(record)
    except DamagedError as error:
        raise InputError(
            f'{path} is no bag or is damaged: {error}; `push_bag recover` saves the intact part'
        ) from None


def _records(file: ByteFile, contents: BagContents) -> Iterator[RawMessage | RawRecord]:
    for span in spans(file):
        if span.opcode == Opcode.CHUNK:
            yield from chunk_records(chunk(file, span))
        elif span.opcode == Opcode.MESSAGE:
            yield message(raw_record(file, span).body)
        elif span.opcode == Opcode.ATTACHMENT:
            contents.attachments.append(attachment(file, span))
        elif contents.reads(span.opcode) and span.opcode != Opcode.STATISTICS:
            yield raw_record(file, span)
