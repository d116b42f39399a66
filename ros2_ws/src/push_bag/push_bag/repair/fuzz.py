"""`push_bag fuzz RUN`: spoils copies of a bag and looks what reading them does."""

import argparse
import random
import resource
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from push_core.common import InputError, Parser, PushError, RunError, run_command
from tqdm import tqdm

from push_bag.commands.info import bag_text
from push_bag.file import BagReader
from push_bag.repair.damage import DAMAGES
from push_bag.repair.recover import recover
from push_bag.replay import in_order, survey
from push_bag.score import score_run

LARGEST = 1_000_000  # [B] of the bag; a short one is spoilt all over in fewer cases


def main(argv: Sequence[str] | None = None) -> int:
    """Spoils a bag again and again."""
    return run_command(_parser(), _work, argv)


def replayed(path: Path) -> int:
    """What a replay reads: the topics, then the records in order."""
    return sum(1 for _ in in_order(BagReader(path).records(survey(path, None).topics)))


READINGS: dict[str, Callable[[Path], object]] = {
    'info': lambda path: bag_text(BagReader(path)),
    'score': score_run,
    'replay': replayed,
    'recover': lambda path: recover(path, path.with_suffix('')),
}


def _work(arguments: argparse.Namespace) -> None:
    source = BagReader(arguments.run).path
    if source.stat().st_size > LARGEST:
        raise InputError(f'{source} is larger than {LARGEST} B; name a shorter run')
    whole, chance = source.read_bytes(), random.Random(arguments.seed)
    read, slowest = Counter[str](), dict.fromkeys(READINGS, 0.0)
    with tempfile.TemporaryDirectory(prefix='push_fuzz_') as scratch:
        for number in tqdm(range(arguments.cases), unit='case', disable=None, leave=False):
            path = Path(scratch) / f'case_{number}.mcap'
            path.write_bytes(DAMAGES[number % len(DAMAGES)](bytearray(whole), chance))
            for name in READINGS:
                started = time.process_time()
                read[name] += _is_read(name, path)
                slowest[name] = max(slowest[name], time.process_time() - started)
            path.unlink()
    for name, count in read.items():
        sys.stdout.write(
            f'{name}: {count} of {arguments.cases} read, the others refused in one line; '
            f'at most {1e3 * slowest[name]:.0f} ms of processor time\n'
        )
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    sys.stdout.write(f'memory: at most {memory:.0f} MB\n')


def _is_read(name: str, path: Path) -> bool:
    """Whether a spoilt bag was read; anything but a clean error ends the run.

    Raises:
        RunError: names the case, so that it can be made again.
    """
    try:
        READINGS[name](path)
    except PushError:
        return False
    except Exception as error:
        raise RunError(f'{name} of {path.stem} ended with {error!r}') from error
    return True


def _parser() -> Parser:
    parser = Parser('Spoils copies of a short bag and reads them: only clean errors may come.')
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    parser.add_argument('--cases', type=int, default=2000, help='default 2000')
    parser.add_argument('--seed', type=int, default=0, help='of the damage; default 0')
    return parser


if __name__ == '__main__':
    sys.exit(main())
