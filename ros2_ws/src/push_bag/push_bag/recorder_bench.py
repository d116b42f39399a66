"""`push_bag bench`: what the recorder takes, keeps and loses, measured."""

import argparse
import random
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import rclpy
from push_core.command_line import Parser, run_command
from push_core.errors import InputError, RunError
from tqdm import tqdm

from push_bag.reader import BagReader
from push_bag.recorder_load import READY_TIMEOUT, Publisher, RecorderProcess, at_rate, new_node
from push_bag.recover import recover
from push_bag.traffic import Traffic

CELL_RATE = 100.0  # [1/s] ticks
EPILOG = """
Three measurements over real DDS, on this machine as busy as it is:
  cell    processor time and memory at the cell's own rate, and messages lost
  load    messages of 1 KB at a high rate: published, recorded, and counted as lost
  kills   SIGKILL at random moments: how far back the recovered bag ends, in the worst case
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Measures the recorder."""
    return run_command(_parser(), _work, argv)


def _parser() -> Parser:
    parser = Parser('Measures the recorder.', EPILOG)
    parser.add_argument('--seconds', type=float, default=60.0, help='of cell and load; default 60')
    parser.add_argument('--rate', type=float, default=3000.0, help='of load [1/s]; default 3000')
    parser.add_argument('--kills', type=int, default=20, help='default 20')
    return parser


def _work(arguments: argparse.Namespace) -> None:
    node = new_node()
    try:
        with tempfile.TemporaryDirectory(prefix='push_bench_') as scratch:
            _say(_cell(Publisher(node), Path(scratch) / 'cell', arguments.seconds))
            _say(_load(Publisher(node), Path(scratch) / 'load', arguments))
            if arguments.kills:
                _say(_kills(Publisher(node), Path(scratch), arguments.kills))
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _say(text: str) -> None:
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
        words = recorder.stop()
    return f'cell: {100 * share:.1f} % of a core, {memory:.0f} MB, {grown:+.1f} MB; {words}'


def _load(publisher: Publisher, folder: Path, arguments: argparse.Namespace) -> str:
    with RecorderProcess(folder, 'topics:=load') as recorder:
        publisher.wait()
        rate = at_rate(publisher.load, arguments.rate, arguments.seconds)
        recorder.stop()
    seen = Traffic()
    for record in BagReader(folder).records(['/load']):
        seen.saw(record.sequence, record.log_ns)
    sent = publisher.sent['load']
    return (
        f'load: {rate:.0f} messages/s of 1 KB; {sent} published, {seen.received} recorded, '
        f'{sent - seen.received} missing, {seen.lost} counted as lost'
    )


def _kills(publisher: Publisher, scratch: Path, count: int) -> str:
    chance = random.Random(0)
    ages = []
    for number in tqdm(range(count), unit='kill', disable=None, leave=False):
        folder = scratch / f'kill_{number}'
        with RecorderProcess(folder, 'topics:=load') as recorder:
            _warm_up(publisher, folder)
            at_rate(publisher.tick, CELL_RATE, chance.uniform(0.0, 2.0))
            last = publisher.sent_at['object_pose'][-1]
            recorder.kill()
        recover(folder, folder.with_name(f'saved_{number}'))
        saved = BagReader(folder.with_name(f'saved_{number}')).records(['/object_pose'])
        ages.append((last - max(record.log_ns for record in saved)) * 1e-9)
    return f'kills: {count}; the recovered bags end up to {max(ages):.2f} s before the kill'


def _warm_up(publisher: Publisher, folder: Path) -> None:
    """Publishes until the bag has its first messages: a killed recorder still seems to listen.

    Raises:
        RunError: it gets none.
    """
    end = time.monotonic() + READY_TIMEOUT
    while not _has_poses(folder):
        at_rate(publisher.tick, CELL_RATE, 0.05)
        if time.monotonic() > end:
            raise RunError('the recorder records nothing')


def _has_poses(folder: Path) -> bool:
    try:
        return any(True for _ in BagReader(folder).records(['/object_pose']))
    except InputError:
        return False


if __name__ == '__main__':
    sys.exit(main())
