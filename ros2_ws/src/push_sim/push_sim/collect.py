"""The command that collects pushes in the simulator: `ros2 run push_sim collect`."""

import argparse
import multiprocessing
import sys
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from push_core.command_line import Parser, run_command
from push_core.errors import InputError
from push_core.frames import Array
from push_core.push_csv import write_pushes
from push_core.push_set import PushSet
from push_core.slider import Slider
from tqdm import tqdm

from push_sim.collector import Collector, PushDesign
from push_sim.settings import PROFILES, profile

_CHUNK = 50
_MAX_JOBS = 256
_push_of_number: Callable[[int], Array]


def collect(
    pushes: int,
    seed: int,
    profile_name: str = 'irb120',
    design: PushDesign | None = None,
    jobs: int = 1,
) -> PushSet:
    """Makes pushes in the simulator; the rows do not depend on the number of processes.

    Args:
        pushes: how many.
        seed: of contact points, directions and noise, not negative.
        profile_name: of the cell; its cameras' noise is in the rows.
        design: which pushes; default: as the measured ones.
        jobs: number of processes.
    """
    design = design or PushDesign()
    make = partial(Collector, profile(profile_name), Slider(), design)
    rows = _rows(make, pushes, seed, jobs)
    table = np.array(list(tqdm(rows, 'collecting', pushes, unit=' pushes', disable=None)))
    return PushSet(table[:, 0], table[:, 1], table[:, 2:], design.distance)


def _rows(make: Callable[[], Collector], pushes: int, seed: int, jobs: int) -> Iterator[Array]:
    if jobs == 1:
        collector = make()
        yield from (collector.push(seed, number) for number in range(pushes))
        return
    # a forked physics server would be shared
    context = multiprocessing.get_context('spawn')
    with context.Pool(jobs, _start_worker, (make, seed)) as pool:
        yield from pool.imap(_push_in_worker, range(pushes), _CHUNK)


def _start_worker(make: Callable[[], Collector], seed: int) -> None:
    global _push_of_number  # noqa: PLW0603
    _push_of_number = partial(make().push, seed)


def _push_in_worker(number: int) -> Array:
    return _push_of_number(number)


def parser() -> Parser:
    """Describes the command line."""
    design = PushDesign()
    described = Parser('Collects straight pushes in the simulator as a CSV file.')
    described.add_argument('--pushes', type=int, required=True, metavar='N', help='how many')
    described.add_argument('-o', '--output', type=Path, required=True, metavar='FILE')
    described.add_argument('--seed', type=int, default=0, help='of all draws (default 0)')
    described.add_argument('--profile', choices=PROFILES, default='irb120')
    described.add_argument('--jobs', type=int, default=1, metavar='N', help='processes')
    described.add_argument(
        '--speed', type=float, default=design.speed, help='of the tip [m/s] (default %(default)s)'
    )
    described.add_argument(
        '--duration', type=float, default=design.duration, help='[s] (default %(default)s)'
    )
    return described


def work(arguments: argparse.Namespace) -> None:
    """Collects and writes.

    Raises:
        InputError: a number is out of its range, or the file cannot be written.
    """
    _check_range('--pushes', arguments.pushes, 1, 10**7)
    _check_range('--seed', arguments.seed, 0, 2**62)
    _check_range('--jobs', arguments.jobs, 1, _MAX_JOBS)
    _check_folder(arguments.output)
    design = PushDesign(speed=arguments.speed, duration=arguments.duration)
    pushes = collect(arguments.pushes, arguments.seed, arguments.profile, design, arguments.jobs)
    write_pushes(arguments.output, pushes)
    sys.stdout.write(f'{len(pushes)} pushes in {arguments.output}\n')


def _check_range(name: str, value: int, low: int, high: int) -> None:
    if not low <= value <= high:
        raise InputError(f'{name} is {value}, must be between {low} and {high}')


def _check_folder(output: Path) -> None:
    """Fails before the work is done, not after."""
    if not output.parent.is_dir():
        raise InputError(f'cannot write {output}: there is no folder {output.parent}')


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command."""
    return run_command(parser(), work, argv)


if __name__ == '__main__':
    raise SystemExit(main())
