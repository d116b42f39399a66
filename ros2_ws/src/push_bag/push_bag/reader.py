"""Streams a bag: whole, or cut short before its end."""

import struct
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, NamedTuple

import zstandard
from mcap.exceptions import EndOfFile, McapError
from mcap.records import Attachment, Channel, Chunk, Footer, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader, breakup_chunk
from push_core.errors import InputError
from rclpy.serialization import deserialize_message

from push_bag.bag_writer import FACTS_RECORD
from push_bag.message_types import message_class

# what the library lets out where bytes are not what they should be
CUT_SHORT = (EndOfFile, struct.error)
DAMAGED = (McapError, ValueError, KeyError, zstandard.ZstdError, MemoryError)


@dataclass(frozen=True)
class Topic:
    """A topic as the bag describes it.

    Attributes:
        name: full name.
        type_name: in three parts.
        qos: the offered profiles as rosbag2's YAML list.
        type_hash: `RIHS01_…`, empty where the bag has none.
    """

    name: str
    type_name: str
    qos: str
    type_hash: str


class Record(NamedTuple):
    """One message as it lies in the bag: raw, with its times."""

    topic: Topic
    data: bytes
    log_ns: int
    publish_ns: int
    sequence: int

    def message(self) -> Any:
        """The decoded message.

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
    """One bag, read from its beginning each time `records` is called.

    Attributes:
        path: the MCAP file.
        facts: of the run; complete once the first message was read.
        attachments: whole files by name; complete once the first message was read.
        topics: by name; complete once all records were read.
        finished: whether the file came to its proper end; known once all records were read.
    """

    def __init__(self, path: Path) -> None:
        """Finds the bag.

        Args:
            path: a run folder or an MCAP file.

        Raises:
            InputError: there is no bag.
        """
        self.path = _bag_file(path)
        self.facts: dict[str, str] = {}
        self.attachments: dict[str, bytes] = {}
        self.topics: dict[str, Topic] = {}
        self.finished = False
        self._schemas: dict[int, str] = {}
        self._channels: dict[int, Topic] = {}

    def records(self, names: Collection[str] | None = None) -> Iterator[Record]:
        """All messages in the order of the file, in bounded memory.

        Args:
            names: full names of the topics to read; None for all.

        Raises:
            InputError: the file is empty, not a bag, or damaged before its end.
        """
        with self.path.open('rb') as stream:
            for record in self._unpacked(stream):
                found = self._noted(record)
                if found is not None and (names is None or found.topic.name in names):
                    yield found

    def _unpacked(self, stream: IO[bytes]) -> Iterator[McapRecord]:
        size = self.path.stat().st_size
        # a record cannot be longer than its file; a damaged length would be read into memory
        reader = StreamReader(stream, emit_chunks=True, record_size_limit=size)
        try:
            for record in reader.records:
                yield from breakup_chunk(record, True) if isinstance(record, Chunk) else (record,)
        except CUT_SHORT:
            if not self._channels:
                raise InputError(f'{self.path} ends before its first message') from None
        except DAMAGED as error:
            raise InputError(f'{self.path} is no bag or is damaged: {error}') from None

    def _noted(self, record: McapRecord) -> Record | None:
        """Remembers what a record says of the bag; gives back the messages."""
        if isinstance(record, Message):
            topic = self._channels[record.channel_id]
            return Record(
                topic, record.data, record.log_time, record.publish_time, record.sequence
            )
        if isinstance(record, Schema):
            self._schemas[record.id] = record.name
        elif isinstance(record, Channel):
            self._note_channel(record)
        elif isinstance(record, Metadata) and record.name == FACTS_RECORD:
            self.facts = dict(record.metadata)
        elif isinstance(record, Attachment):
            self.attachments[record.name] = record.data
        elif isinstance(record, Footer):
            self.finished = True
        return None

    def _note_channel(self, channel: Channel) -> None:
        topic = Topic(
            channel.topic,
            self._schemas.get(channel.schema_id, ''),
            channel.metadata.get('offered_qos_profiles', ''),
            channel.metadata.get('topic_type_hash', ''),
        )
        self._channels[channel.id] = topic
        self.topics[topic.name] = topic


def _bag_file(path: Path) -> Path:
    if path.is_file():
        return path
    if not path.is_dir():
        raise InputError(f'{path} does not exist; name a run folder or an MCAP file')
    bags = sorted(path.glob('*.mcap'))
    if len(bags) != 1:
        raise InputError(f'{path} holds {len(bags)} MCAP files; name the one to read')
    return bags[0]
