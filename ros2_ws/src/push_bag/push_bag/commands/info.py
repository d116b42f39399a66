"""`push_bag info RUN`: prints the contents of a bag."""

import argparse
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import InputError, Parser, plain_table, run_command, write_atomically

from push_bag.file import BagReader, Traffic, lost_text


def main(argv: Sequence[str] | None = None) -> int:
    """Prints the contents of a bag."""
    return run_command(_parser(), _work, argv)


def bag_text(reader: BagReader) -> str:
    """Topics, types, counts, rates, losses, duration and facts of a bag.

    Raises:
        InputError: the bag is not readable.
    """
    traffic: dict[str, Traffic] = {}
    for record in reader.records():
        traffic.setdefault(record.topic.name, Traffic()).add(record.sequence, record.log_ns)
    lines = [f'{reader.path}: {_duration(traffic):.2f} s, {_ending(reader)}', '']
    lines += _topic_lines(reader, traffic)
    lines += ['', lost_text(traffic), '']
    lines += [f'{name}: {value}' for name, value in sorted(reader.facts.items())]
    lines += [f'attached: {name}, {len(data)} B' for name, data in reader.attachments.items()]
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
        for name, data in reader.attachments.items():
            write_atomically(folder / Path(name).name, data)
    except InputError:
        shutil.rmtree(folder)
        raise


def _topic_lines(reader: BagReader, traffic: dict[str, Traffic]) -> list[str]:
    rows = [('topic', 'type', 'received', 'lost', 'rate [1/s]', 'longest gap [ms]')]
    for name, topic in sorted(reader.topics.items()):
        seen = traffic.get(name, Traffic())
        lost = str(seen.lost) if seen.numbered or not seen.received else '?'
        gap = f'{seen.longest_ns * 1e-6:.1f}'
        rows.append((name, topic.type_name, str(seen.received), lost, f'{seen.rate:.1f}', gap))
    return plain_table(rows, left=2)


def _duration(traffic: dict[str, Traffic]) -> float:
    seen = traffic.values()
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
