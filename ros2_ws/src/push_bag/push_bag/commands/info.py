"""`push_bag info RUN`: prints the contents of a bag."""

import argparse
import itertools
import os
import shutil
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from push_core.common import InputError, Parser, plain_table, run_command

from push_bag.file import BagReader, Traffic, TrafficLog, counted, lost_text
from push_bag.stream import Attachment

Key = tuple[str, str]  # name and type of a topic


def main(argv: Sequence[str] | None = None) -> int:
    """Prints the contents of a bag."""
    return run_command(_parser(), _work, argv)


def bag_text(reader: BagReader) -> str:
    """Topics, types, counts, rates, losses, duration and facts of a bag.

    Raises:
        InputError: the bag is not readable.
    """
    logs: dict[Key, TrafficLog] = {}
    for record in reader.records():
        key = record.topic.name, record.topic.type_name
        logs.setdefault(key, TrafficLog()).add(record.sequence, record.log_ns)
    traffic = counted(logs)
    lines = [f'{reader.path}: {_duration(traffic):.2f} s, {_ending(reader)}']
    if len(reader.paths) > 1:
        names = ', '.join(path.name for path in reader.paths)
        lines.append(f'{len(reader.paths)} files: {names}')
    lines += ['', *_topic_lines(reader, traffic)]
    lines += ['', lost_text(_named(traffic)), '']
    lines += [f'{name}: {value}' for name, value in sorted(reader.facts.items())]
    lines += [f'attached: {each.name}, {each.size} B' for each in reader.attached]
    return '\n'.join(lines) + '\n'


def extract(reader: BagReader, folder: Path) -> None:
    """Writes the attachments to a new folder; the bag must have been read.

    Raises:
        InputError: the folder exists, or cannot be written.
    """
    try:
        folder.mkdir(parents=True)
    except FileExistsError:
        raise InputError(f'{folder} exists; name a new folder with --extract') from None
    except OSError as error:
        raise InputError(f'cannot create {folder}: {error.strerror}') from error
    try:
        for each in reader.attached:
            _write_attached(_free_path(folder, each.name), each)
    except InputError:
        shutil.rmtree(folder)
        raise


def _free_path(folder: Path, name: str) -> Path:
    """A path in the folder that is not taken: attachments may have equal names."""
    path = folder / Path(name).name
    numbers = itertools.count(2)
    while path.exists():
        path = folder / f'{Path(name).stem}_{next(numbers)}{Path(name).suffix}'
    return path


def _write_attached(path: Path, attached: Attachment) -> None:
    try:
        with path.open('wb') as stream:
            for block in attached.blocks():
                stream.write(block)
            stream.flush()
            os.fsync(stream.fileno())
    except OSError as error:
        raise InputError(f'cannot write {path}: {error.strerror}') from error


def _named(traffic: Mapping[Key, Traffic]) -> dict[str, Traffic]:
    """The traffic by name of the topic; with the type where a topic has several."""
    names = [name for name, _ in traffic]
    return {
        name if names.count(name) == 1 else f'{name} ({kind})': each
        for (name, kind), each in traffic.items()
    }


def _topic_lines(reader: BagReader, traffic: Mapping[Key, Traffic]) -> list[str]:
    rows = [('topic', 'type', 'received', 'lost', 'rate [1/s]', 'longest gap [ms]')]
    for name, kind in sorted({(each.name, each.type_name) for each in reader.all_topics}):
        seen = traffic.get((name, kind), Traffic())
        lost = str(seen.lost) if seen.lost_is_known else '?'
        gap = f'{seen.longest_ns * 1e-6:.1f}'
        rows.append((name, kind or '-', str(seen.received), lost, f'{seen.rate:.1f}', gap))
    return plain_table(rows, left=2)


def _duration(traffic: Mapping[Key, Traffic]) -> float:
    seen = [each for each in traffic.values() if each.received]
    first = min((each.first_ns for each in seen), default=0)
    return (max((each.last_ns for each in seen), default=0) - first) * 1e-9


def _ending(reader: BagReader) -> str:
    return 'finished' if reader.finished else 'unfinished: the recording was cut short'


def _parser() -> Parser:
    parser = Parser('Prints the topics, counts, rates, losses and facts of a bag.')
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    parser.add_argument(
        '--extract',
        type=Path,
        metavar='FOLDER',
        help='write the attachments (parameters, model, track) to a new folder',
    )
    return parser


def _work(arguments: argparse.Namespace) -> None:
    reader = BagReader(arguments.run)
    sys.stdout.write(bag_text(reader))
    if arguments.extract is not None:
        extract(reader, arguments.extract)


if __name__ == '__main__':
    sys.exit(main())
