"""Measures the recorder: processor time and memory, messages lost, and what a kill loses."""

import argparse
import random
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from push_bag.file import BagReader, Traffic
from push_bag.repair.recover import recover
from push_core.common import Parser, run_command
from recorder_load import Publisher, RecorderProcess, at_rate, new_publisher
from tqdm import tqdm

CELL_RATE = 100.0  # [1/s] ticks
EPILOG = """
Three measurements over DDS; other load on the machine counts:
  cell    processor time and memory at the rates of the cell, and messages lost
  load    messages of 1 KB at a high rate: published, recorded, and counted as lost
  kills   SIGKILL at random times: how long before the kill the recovered bags end, at most
Example: scripts/in_env python tests/tools/load/bench_recorder.py --seconds 10 --kills 5
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Measures the recorder."""
    return run_command(_parser(), _work, argv)


def _parser() -> Parser:
    parser = Parser(str(__doc__), EPILOG)
    parser.add_argument('--seconds', type=float, default=60.0, help='of cell and load; default 60')
    parser.add_argument('--rate', type=float, default=3000.0, help='of load [1/s]; default 3000')
    parser.add_argument('--kills', type=int, default=20, help='default 20')
    return parser


def _work(arguments: argparse.Namespace) -> None:
    with tempfile.TemporaryDirectory(prefix='push_bench_') as scratch:
        with new_publisher() as publisher:
            _write(_cell(publisher, Path(scratch) / 'cell', arguments.seconds))
        with new_publisher() as publisher:
            _write(_load(publisher, Path(scratch) / 'load', arguments))
        if arguments.kills:
            _write(_kills(Path(scratch), arguments.kills))


def _write(text: str) -> None:
    sys.stdout.write(text + '\n')
    sys.stdout.flush()


def _cell(publisher: Publisher, folder: Path, seconds: float) -> str:
    with RecorderProcess(folder, 'topics:=load') as recorder:
        publisher.wait()
        at_rate(publisher.tick, CELL_RATE, 2.0)
        before, memory = recorder.processor_time, recorder.memory
        at_rate(publisher.tick, CELL_RATE, seconds)
        share = (recorder.processor_time - before) / seconds
        grown = recorder.memory - memory
        summary = recorder.stop()
    return f'cell: {100 * share:.1f} % of a core, {memory:.0f} MB, {grown:+.1f} MB; {summary}'


def _load(publisher: Publisher, folder: Path, arguments: argparse.Namespace) -> str:
    with RecorderProcess(folder, 'topics:=load') as recorder:
        publisher.wait()
        rate = at_rate(publisher.load, arguments.rate, arguments.seconds)
        publisher.wait_until_acknowledged()
        recorder.stop()
    seen = Traffic()
    for record in BagReader(folder).records(['/load']):
        seen.add(record.sequence, record.log_ns)
    sent = publisher.sent['load']
    return (
        f'load: {rate:.0f} messages/s of 1 KB; {sent} published, {seen.received} recorded, '
        f'{sent - seen.received} missing, {seen.lost} counted as lost'
    )


def _kills(scratch: Path, count: int) -> str:
    chance = random.Random(0)
    ages = []
    for number in tqdm(range(count), unit='kill', disable=None, leave=False):
        folder = scratch / f'kill_{number}'
        with new_publisher() as publisher, RecorderProcess(folder, 'topics:=load') as recorder:
            publisher.wait()
            at_rate(publisher.tick, CELL_RATE, chance.uniform(0.5, 2.5))
            last = publisher.sent_at['object_pose'][-1]
            recorder.kill()
        recover(folder, folder.with_name(f'saved_{number}'))
        saved = BagReader(folder.with_name(f'saved_{number}')).records(['/object_pose'])
        ages.append((last - max(record.log_ns for record in saved)) * 1e-9)
    return f'kills: {count}; the recovered bags end up to {max(ages):.2f} s before the kill'


if __name__ == '__main__':
    sys.exit(main())
