"""Writes a run to an MCAP bag that rosbag2 and Foxglove can read."""

import time
from collections import Counter
from collections.abc import Callable, Mapping
from pathlib import Path
from types import TracebackType
from typing import IO, Any

from mcap.writer import CompressionType, Writer
from push_core.common import InputError, RunError

from push_bag.file.message_types import Definition, installed_definition
from push_bag.file.rosbag2_metadata import TimeSpan, write_metadata
from push_bag.file.topic_registry import Topic, TopicRegistry
from push_bag.stream import Attachment, ChunkIndexes, write_attachment

CHUNK_BYTES = 64 * 1024  # bounds what a kill can lose and how long a write can block
FACTS_RECORD = 'run'
COUNTS_RECORD = 'recording'  # received and lost messages, written last
LARGEST_SEQUENCE = 0xFFFFFFFF


class BagWriter:
    """A run folder with one MCAP file, open for writing.

    Facts and attachments are written first, so that a recording that is cut short has them. After
    a write error (a full disk) the bag is closed; what was written stays readable.
    Use it as a context manager or call `close`.

    Attributes:
        path: the MCAP file.
        counts: messages written per topic.
    """

    def __init__(
        self,
        folder: Path,
        facts: Mapping[str, str],
        attachments: Mapping[str, bytes],
        profile: str = 'ros2',
    ) -> None:
        """Creates the folder and the file.

        Args:
            folder: of the run; must not exist yet.
            facts: of the run (profile, seed, mode, versions …).
            attachments: contents of files by name.
            profile: of the MCAP file.

        Raises:
            InputError: the folder exists already or cannot be created.
            RunError: the file cannot be written.
        """
        self.folder = _new_folder(folder)
        self.path = self.folder / f'{self.folder.name}_0.mcap'
        self.counts: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._written = Counter[int]()  # messages by channel
        self._facts = dict(facts)
        self._first_ns: int | None = None
        self._last_ns = 0
        self._stream: IO[bytes] | None = _new_file(self.path)
        self._writer = Writer(self._stream, CHUNK_BYTES, CompressionType.ZSTD)
        # the library's writer, whose version is pinned, has no other way to keep them on disk
        self._indexes = ChunkIndexes(self.folder)
        vars(self._writer)['_Writer__chunk_indices'] = self._indexes
        self._registry = TopicRegistry(self._writer)
        self._attempt(lambda: self._write_head(attachments, profile))

    @property
    def is_open(self) -> bool:
        """Whether messages can be written: not closed, and no write has failed."""
        return self._stream is not None

    def add_topic(
        self, name: str, type_name: str, qos_yaml: str, definition: Definition | None = None
    ) -> None:
        """Declares a topic before its first message.

        Args:
            name: full name, with the leading slash.
            type_name: in three parts, `geometry_msgs/msg/PoseStamped`.
            qos_yaml: the offered profiles as rosbag2's YAML list, see `qos_text`.
            definition: of the type; None for the installed one.

        Raises:
            InputError: the type is not installed, or the topic was added before.
            RunError: the file cannot be written.
        """
        if name in self.counts:
            raise InputError(f'topic {name} is already in {self.path}')
        definition = definition or installed_definition(type_name)
        self._channels[name] = self.add_channel(
            Topic.of_ros(name, type_name, qos_yaml, definition)
        )

    def add_channel(self, topic: Topic) -> int:
        """Declares a channel; a topic can have several, of different types or publishers.

        Returns:
            Its number, for `write_to`.

        Raises:
            RunError: the file cannot be written.
        """
        channels: list[int] = []
        self._attempt(lambda: channels.append(self._registry.add(topic)))
        self.counts.setdefault(topic.name, 0)
        return channels[0]

    def write(
        self, name: str, data: bytes, log_ns: int, publish_ns: int, sequence: int = 0
    ) -> None:
        """Appends one serialized message.

        Args:
            name: topic, already added.
            data: CDR with its 4-byte header.
            log_ns: when it was received [ns].
            publish_ns: when it was published [ns].
            sequence: number by its publisher, from 1; 0 where unknown.

        Raises:
            RunError: the file cannot be written, and is closed.
        """
        self.write_to(self._channels[name], data, log_ns, publish_ns, sequence)

    def write_to(
        self, channel: int, data: bytes, log_ns: int, publish_ns: int, sequence: int = 0
    ) -> None:
        """Appends one serialized message to a channel; see `write`.

        Raises:
            RunError: the file cannot be written, and is closed.
        """
        number = sequence & LARGEST_SEQUENCE
        self._attempt(lambda: self._writer.add_message(channel, log_ns, data, publish_ns, number))
        self._written[channel] += 1
        self.counts[self._registry.topic(channel).name] += 1
        self._first_ns = log_ns if self._first_ns is None else min(log_ns, self._first_ns)
        self._last_ns = max(log_ns, self._last_ns)

    def add_facts(self, name: str, facts: Mapping[str, str]) -> None:
        """Writes a metadata record at the current place of the file.

        Args:
            name: of the record.
            facts: its values.

        Raises:
            RunError: the file cannot be written, and is closed.
        """
        if name == FACTS_RECORD:
            self._facts = {**facts, **self._facts}
        self._attempt(lambda: self._writer.add_metadata(name, dict(facts)))

    def attach(self, name: str, data: bytes) -> None:
        """Attaches a file at the current place of the bag.

        Raises:
            RunError: the file cannot be written, and is closed.
        """
        self._attempt(lambda: self._add_attachment(name, data))

    def add_attachment(self, attached: Attachment) -> None:
        """Copies an attached file of another bag, piece by piece.

        Raises:
            RunError: the file cannot be written, and is closed.
        """
        self._attempt(lambda: self._copy_attachment(attached))

    def flush(self) -> None:
        """Ends the current chunk and hands it to the operating system.

        Raises:
            RunError: the file cannot be written, and is closed.
        """
        self._attempt(self._writer.flush)

    def close(self) -> None:
        """Writes index and footer, then `metadata.yaml`; a second call does nothing.

        Raises:
            RunError: the file cannot be written.
        """
        if self._stream is not None:
            self._attempt(self._finish)

    def __enter__(self) -> 'BagWriter':
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def _attempt(self, work: Callable[[], object]) -> None:
        if self._stream is None:
            raise RunError(f'{self.path} is closed')
        try:
            work()
        except OSError as error:
            self._abandon()
            reason = error.strerror or str(error)
            raise RunError(
                f'{self.path}: {reason}; recording stopped, what was recorded stays readable'
            ) from error

    def _add_attachment(self, name: str, data: bytes) -> None:
        now = time.time_ns()
        self._writer.add_attachment(now, now, name, 'application/octet-stream', data)

    def _copy_attachment(self, attached: Attachment) -> None:
        """Writes the record here because the library's writer takes all data at once."""
        self._writer.flush()  # type: ignore[no-untyped-call]
        stream: Any = self._stream
        index = write_attachment(stream, attached)
        own = vars(self._writer)
        own['_Writer__attachment_indexes'].append(index)
        own['_Writer__statistics'].attachment_count += 1

    def _write_head(self, attachments: Mapping[str, bytes], profile: str) -> None:
        self._writer.start(profile=profile, library='push_bag')
        self._writer.add_metadata(FACTS_RECORD, self._facts)
        for name, data in attachments.items():
            self._add_attachment(name, data)
        self._writer.flush()  # type: ignore[no-untyped-call]

    def _finish(self) -> None:
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._close_stream()
        span = TimeSpan(self._first_ns or 0, self._last_ns)
        try:
            write_metadata(
                self.folder,
                self.path.name,
                self._registry.summaries(self._written),
                span,
                self._facts,
            )
        except InputError as error:
            raise RunError(str(error)) from error

    def _close_stream(self) -> None:
        stream: Any = self._stream
        self._stream = None
        if stream is not None:
            stream.close()
            self._indexes.close()

    def _abandon(self) -> None:
        try:
            self._close_stream()
        except OSError:
            # closing flushes again, which fails for the same reason
            return


def _new_folder(folder: Path) -> Path:
    folder = folder.absolute()
    try:
        folder.mkdir(parents=True)
    except FileExistsError:
        raise InputError(f'{folder} exists already; name a new folder') from None
    except OSError as error:
        raise InputError(f'{folder} cannot be created: {error.strerror}') from None
    return folder


def _new_file(path: Path) -> IO[bytes]:
    try:
        return path.open('wb')
    except OSError as error:
        path.parent.rmdir()
        raise InputError(f'{path} cannot be created: {error.strerror}') from None
