"""`push_bag recover BROKEN -o OUT`: writes a new bag with the intact part of a damaged one."""

import argparse
import contextlib
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from mcap.opcode import Opcode
from push_core.common import InputError, Parser, run_command

from push_bag.file import BagContents, BagWriter, Topic, atomic_bag, bag_files
from push_bag.repair.recovered import Recovered
from push_bag.repair.salvage import Damage, Part, PrivateRecord, parts_of
from push_bag.stream import (
    Attachment,
    ByteFile,
    Chunk,
    DamagedError,
    RawMessage,
    RawRecord,
    chunk_records,
    message,
)

RECOVERY_RECORD = 'recovery'  # saved and missing messages, written last
EPILOG = """
OUT becomes a run folder with one finished bag: every intact chunk of BROKEN, its metadata and its
attachments, as they were; the files of a split bag become one.
Prints how many messages and seconds are missing, from sequence numbers and times.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Recovers a bag."""
    return run_command(_parser(), _work, argv)


def recover(broken: Path, folder: Path) -> Recovered:
    """Writes a new bag with the intact part of a damaged one.

    Args:
        broken: run folder or MCAP file.
        folder: of the new run; must not exist yet.

    Returns:
        Counts of saved and missing messages.

    Raises:
        InputError: there is no bag, no intact chunk in it, or the folder exists already.
        RunError: the new bag cannot be written.
    """
    paths = bag_files(broken)
    contents = [_contents(path) for path in paths]
    if not any(each.topics for each in contents):
        raise InputError(f'{paths[0] if len(paths) == 1 else broken} {_nothing(paths)}')
    names = ', '.join(path.name for path in paths)
    facts = {'recovered_from': names, 'recovered_bag': _state(contents)}
    profile = next((each.profile for each in contents if each.profile), '')
    with atomic_bag(folder, facts, {}, profile) as writer:
        _copy_facts(contents, writer)
        counts = Recovered(contents)
        channels = _Channels(writer)
        for path, each in zip(paths, contents, strict=True):
            _copy_messages(path, channels.of(each), writer, counts)
        writer.add_facts(RECOVERY_RECORD, counts.facts())
        return counts


def _nothing(paths: Sequence[Path]) -> str:
    empty = not any(path.stat().st_size for path in paths)
    return 'is empty' if empty else 'holds nothing that can be recovered'


def _state(contents: Sequence[BagContents]) -> str:
    return 'came to its end' if all(each.finished for each in contents) else 'was cut short'


def _contents(path: Path) -> BagContents:
    """Topics, facts and attachments of all intact parts.

    Topics from chunks take precedence: chunks have checksums, the records of the summary do not.
    """
    contents, unverified = BagContents(), []
    with ByteFile(path) as file:
        for part in parts_of(file):
            if isinstance(part, RawRecord) and part.opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
                unverified.append(part)
            elif isinstance(part, Attachment):
                contents.attachments.append(part)
            else:
                _read(contents, part)
        for record in unverified:
            _read(contents, record)
    return contents


def _read(contents: BagContents, part: Part) -> None:
    with contextlib.suppress(DamagedError):
        for record in _records(part):
            if isinstance(record, RawRecord):
                with contextlib.suppress(DamagedError):
                    contents.add(record)


def _copy_facts(contents: Sequence[BagContents], writer: BagWriter) -> None:
    for each in contents:
        for name, values in each.metadata:
            writer.add_facts(name, values)
        for attached in each.attachments:
            writer.add_attachment(attached)


class _Channels:
    """The channels of the new bag; a channel that each file of a split bag repeats is one."""

    def __init__(self, writer: BagWriter) -> None:
        self._writer = writer
        self._added: list[tuple[Topic, int]] = []

    def of(self, contents: BagContents) -> dict[int, tuple[Topic, int]]:
        """Topic and number in the new bag of each channel of a file."""
        free = list(self._added)
        channels: dict[int, tuple[Topic, int]] = {}
        for number, topic in contents.topics.items():
            same = next((each for each in free if each[0] == topic), None)
            if same is None:
                same = topic, self._writer.add_channel(topic)
                self._added.append(same)
            else:
                free.remove(same)
            channels[number] = same
        return channels


def _copy_messages(
    path: Path, channels: Mapping[int, tuple[Topic, int]], writer: BagWriter, counts: Recovered
) -> None:
    with ByteFile(path) as file:
        for part in parts_of(file):
            if isinstance(part, Damage):
                counts.add_damage(part.length)
            counts.private += isinstance(part, PrivateRecord)
            try:
                for raw in _records(part):
                    if isinstance(raw, RawMessage):
                        _copy(raw, channels, writer, counts)
            except DamagedError:
                # a chunk without a checksum, whose records do not fit together
                counts.add_damage(part.size if isinstance(part, Chunk) else 0)


def _copy(
    raw: RawMessage,
    channels: Mapping[int, tuple[Topic, int]],
    writer: BagWriter,
    counts: Recovered,
) -> None:
    if raw.channel not in channels:
        counts.unknown += 1
        return
    topic, channel = channels[raw.channel]
    writer.write_to(channel, raw.data, raw.log_ns, raw.publish_ns, raw.sequence)
    counts.add(topic.name, raw)


def _records(part: Part) -> Iterator[RawMessage | RawRecord]:
    """The records in a part of the file.

    Raises:
        DamagedError: a record in it is damaged.
    """
    if isinstance(part, Chunk):
        yield from chunk_records(part)
    elif isinstance(part, RawRecord):
        yield message(part.body) if part.opcode == Opcode.MESSAGE else part


def _parser() -> Parser:
    parser = Parser('Writes a new bag with the intact part of a damaged one.', EPILOG)
    parser.add_argument('broken', type=Path, metavar='BROKEN', help='run folder or MCAP file')
    parser.add_argument(
        '-o', '--output', type=Path, required=True, metavar='OUT', help='new run folder'
    )
    return parser


def _work(arguments: argparse.Namespace) -> None:
    counts = recover(arguments.broken, arguments.output)
    sys.stdout.write(counts.text() + f'\n{arguments.output}\n')


if __name__ == '__main__':
    sys.exit(main())
