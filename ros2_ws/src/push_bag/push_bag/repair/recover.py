"""`push_bag recover BROKEN -o OUT`: writes a new bag with the intact part of a damaged one."""

import argparse
import contextlib
import mmap
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from mcap.opcode import Opcode
from push_core.common import InputError, Parser, run_command

from push_bag.file import (
    COUNTS_RECORD,
    BagContents,
    BagWriter,
    DamagedError,
    Definition,
    RawMessage,
    RawRecord,
    Topic,
    atomic_bag,
    bag_file,
    chunk_records,
    message,
    qos_profile,
)
from push_bag.repair.recovered import Recovered
from push_bag.repair.salvage import Damage, IntactChunk, parts_of

RECOVERY_RECORD = 'recovery'  # saved and missing messages, written last
EPILOG = """
OUT becomes a run folder with one finished bag: every intact chunk of BROKEN, facts, attachments.
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
    path = bag_file(broken)
    with _mapped(path) as file:
        contents = _contents(file)
        if not contents.topics:
            raise InputError(f'{path} holds nothing that can be recovered')
        facts = {**contents.facts, 'recovered_from': path.name, 'recovered_bag': _state(contents)}
        with atomic_bag(folder, facts, contents.attachments) as writer:
            counts = _copied(file, contents, writer)
            if contents.counts:
                writer.add_facts(COUNTS_RECORD, contents.counts)
            writer.add_facts(RECOVERY_RECORD, counts.facts())
            return counts


def _state(contents: BagContents) -> str:
    return 'came to its end' if contents.finished else 'was cut short'


def _contents(file: mmap.mmap) -> BagContents:
    """Topics, facts and attachments of all intact parts.

    Topics from chunks take precedence: chunks have checksums, the records of the summary do not.
    """
    contents, unverified = BagContents(), []
    for part in parts_of(file):
        if isinstance(part, RawRecord) and part.opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
            unverified.append(part)
        else:
            _read(contents, part)
    for part in unverified:
        _read(contents, part)
    return contents


def _read(contents: BagContents, part: IntactChunk | RawRecord | Damage) -> None:
    for record in _records(part):
        if isinstance(record, RawRecord):
            with contextlib.suppress(DamagedError):
                contents.add(record)


def _copied(file: mmap.mmap, contents: BagContents, writer: BagWriter) -> Recovered:
    """Copies all messages of known topics."""
    counts = Recovered(contents)
    for each in contents.topics.values():
        _add(writer, each)
    for part in parts_of(file):
        if isinstance(part, Damage):
            counts.add_damage(part.length)
        for raw in _records(part):
            topic = contents.topics.get(raw.channel) if isinstance(raw, RawMessage) else None
            if isinstance(raw, RawMessage) and topic is not None:
                writer.write(topic.name, raw.data, raw.log_ns, raw.publish_ns, raw.sequence)
                counts.add(topic.name, raw)
    return counts


def _records(part: IntactChunk | RawRecord | Damage) -> Iterator[RawMessage | RawRecord]:
    """The records in a part of the file; stops where the part is damaged."""
    with contextlib.suppress(DamagedError):
        if isinstance(part, IntactChunk):
            yield from chunk_records(part.data)
        elif isinstance(part, RawRecord):
            yield message(part.body) if part.opcode == Opcode.MESSAGE else part


def _add(writer: BagWriter, topic: Topic) -> None:
    if topic.name not in writer.counts:
        definition = Definition(topic.schema, topic.type_hash)
        writer.add_topic(topic.name, topic.type_name, _readable(topic.qos), definition)


def _readable(qos: str) -> str:
    """The QoS text; empty if it is damaged."""
    try:
        qos_profile(qos)
    except InputError:
        return ''
    return qos


@contextlib.contextmanager
def _mapped(path: Path) -> Iterator[mmap.mmap]:
    with path.open('rb') as stream:
        if not path.stat().st_size:
            raise InputError(f'{path} is empty')
        with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as file:
            yield file


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
