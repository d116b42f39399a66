"""Damages copies of a short bag and reads them: only `PushError`s may be raised."""

import argparse
import random
import resource
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from push_bag.commands.info import bag_text
from push_bag.file import BagReader
from push_bag.repair.recover import recover
from push_bag.replay import in_order, survey
from push_bag.score import score_run
from push_core.common import InputError, Parser, PushError, RunError, run_command
from tqdm import tqdm

LARGEST = 1_000_000  # [B] of the bag: a few cases damage a short bag in most places
LONGEST_SWAP = 100  # [B]
LONGEST_HOLE = 2000  # [B]
EPILOG = """
Example: scripts/in_env python tests/tools/random_input/fuzz_bag.py runs/RUN --cases 200
"""


def cut(content: bytearray, chance: random.Random) -> bytearray:
    """The file, ended at a random byte."""
    return content[: chance.randrange(len(content))]


def flipped(content: bytearray, chance: random.Random) -> bytearray:
    """The file with 1, 8 or 64 wrong bits."""
    for _ in range(chance.choice((1, 8, 64))):
        content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    return content


def swapped(content: bytearray, chance: random.Random) -> bytearray:
    """The file with four pairs of short pieces exchanged."""
    for _ in range(4):
        here, there = (chance.randrange(len(content) - LONGEST_SWAP) for _ in range(2))
        size = chance.randrange(1, LONGEST_SWAP)
        content[here : here + size], content[there : there + size] = (
            content[there : there + size],
            content[here : here + size],
        )
    return content


def removed(content: bytearray, chance: random.Random) -> bytearray:
    """The file without a random piece; what follows moves up."""
    at = chance.randrange(len(content))
    del content[at : at + chance.randrange(1, LONGEST_HOLE)]
    return content


DAMAGES: tuple[Callable[[bytearray, random.Random], bytearray], ...] = (
    cut,
    flipped,
    swapped,
    removed,
)


def replayed(path: Path) -> int:
    """Reads a bag as a replay does: the topics, then the records in order."""
    bag = survey(path, None)
    return sum(1 for _ in in_order(BagReader(path).records(bag.topics), bag.disorder_ns))


READERS: dict[str, Callable[[Path], object]] = {
    'info': lambda path: bag_text(BagReader(path)),
    'score': score_run,
    'replay': replayed,
    'recover': lambda path: recover(path, path.with_suffix('')),
}


def main(argv: Sequence[str] | None = None) -> int:
    """Damages a bag again and again."""
    return run_command(_parser(), _work, argv)


def _parser() -> Parser:
    parser = Parser(str(__doc__), EPILOG)
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    parser.add_argument('--cases', type=int, default=2000, help='default 2000')
    parser.add_argument('--seed', type=int, default=0, help='of the damage; default 0')
    return parser


def _work(arguments: argparse.Namespace) -> None:
    source = BagReader(arguments.run).path
    if source.stat().st_size > LARGEST:
        raise InputError(f'{source} is larger than {LARGEST} B; name a shorter run')
    content, chance = source.read_bytes(), random.Random(arguments.seed)
    read, slowest = Counter[str](), dict.fromkeys(READERS, 0.0)
    with tempfile.TemporaryDirectory(prefix='push_fuzz_') as scratch:
        for number in tqdm(range(arguments.cases), unit='case', disable=None, leave=False):
            path = Path(scratch) / f'case_{number}.mcap'
            path.write_bytes(DAMAGES[number % len(DAMAGES)](bytearray(content), chance))
            for name in READERS:
                started = time.process_time()
                read[name] += _is_read(name, path)
                slowest[name] = max(slowest[name], time.process_time() - started)
            path.unlink()
    for name in READERS:
        sys.stdout.write(
            f'{name}: {read[name]} of {arguments.cases} read, the others refused in one line; '
            f'at most {1e3 * slowest[name]:.0f} ms of processor time\n'
        )
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    sys.stdout.write(f'memory: at most {memory:.0f} MB\n')


def _is_read(name: str, path: Path) -> bool:
    """Whether a damaged bag was read; False if it was refused with a `PushError`.

    Raises:
        RunError: any other exception; names the case, so that it can be repeated.
    """
    try:
        READERS[name](path)
    except PushError:
        return False
    except Exception as error:
        raise RunError(f'{name} of {path.stem} ended with {error!r}') from error
    return True


if __name__ == '__main__':
    sys.exit(main())
