"""The command that collects pushes in the simulator: `ros2 run push_sim collect`."""

import argparse
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from push_core.common import Parser, check_place, run_command, workers
from push_core.data import PushSet, write_pushes
from push_core.geometry import Array
from push_core.physics import Slider
from tqdm import tqdm

from push_sim.collect import SAMPLINGS, Aim, Collector, PushDesign
from push_sim.commands.command_checks import check_jobs, check_range, check_seed
from push_sim.settings import PROFILES, SimSettings, profile

EPILOG = """how the pushes are chosen (--sampling):
  uniform   drawn evenly over 95 % of the face and directions up to 84 degrees from the normal
  grid      the middles of k x k cells over both; N has to be a square number
  die       the five of a die in turn: the middle of the face along the normal, and half-way to
            each end 30 degrees to either side

examples:
  ros2 run push_sim collect --pushes 5000 -o pushes.csv
  ros2 run push_sim collect --pushes 5 --sampling die --profile ideal -o five.csv
  ros2 run push_sim collect --pushes 400 --sampling grid --speed 0.05 --duration 0.1 -o fast.csv
"""

_MOST_IN_CHUNK = 250


@dataclass(frozen=True)
class Asked:
    """What every process has to know."""

    pushes: int
    seed: int
    settings: SimSettings
    design: PushDesign
    sampling: str

    @property
    def aim(self) -> Aim:
        """Where each push sets out."""
        return SAMPLINGS[self.sampling](self.design, Slider().side, self.pushes)


def collect(
    pushes: int,
    seed: int,
    profile_name: str = 'irb120',
    design: PushDesign | None = None,
    jobs: int = 1,
    sampling: str = 'uniform',
) -> PushSet:
    """Makes pushes in the simulator; the rows do not depend on the number of processes.

    Args:
        pushes: how many.
        seed: of contact points, directions and noise, not negative.
        profile_name: of the cell; its cameras' noise is in the rows.
        design: how the tip pushes; default: as the measured ones.
        jobs: number of processes.
        sampling: one of `SAMPLINGS`.

    Raises:
        InputError: the sampling cannot make so many or such long pushes.
        RunError: a push does not stay on the face.
    """
    asked = Asked(pushes, seed, profile(profile_name), design or PushDesign(), sampling)
    table = np.array(list(collected(asked, jobs)))
    return PushSet(table[:, 0], table[:, 1], table[:, 2:], asked.design.distance)


def collected(asked: Asked, jobs: int) -> Iterator[Array]:
    """All rows (5,) in order; a wrong sampling fails before the processes start."""
    _ = asked.aim
    # a world takes as long to make as five pushes
    size = min(_MOST_IN_CHUNK, math.ceil(asked.pushes / jobs))
    firsts = range(0, asked.pushes, size)
    tasks = ((asked, first, min(first + size, asked.pushes)) for first in firsts)
    bar: tqdm[Any]
    with (
        tqdm(desc='collecting', total=asked.pushes, unit=' pushes', disable=None) as bar,
        workers(jobs) as run_in,
    ):
        for chunk in run_in(_chunk, tasks):
            bar.update(len(chunk))
            yield from chunk


def _chunk(asked: Asked, first: int, end: int) -> list[Array]:
    """The rows of the pushes of some numbers."""
    with Collector(asked.settings, Slider(), asked.design, asked.aim) as collector:
        return [collector.push(asked.seed, number) for number in range(first, end)]


def parser() -> Parser:
    """Describes the command line."""
    design = PushDesign()
    described = Parser('Collects straight pushes in the simulator as a CSV file.', EPILOG)
    described.add_argument('--pushes', type=int, required=True, metavar='N', help='how many')
    described.add_argument('-o', '--output', type=Path, required=True, metavar='FILE')
    described.add_argument('--seed', type=int, default=0, help='of all draws (default 0)')
    described.add_argument(
        '--sampling', choices=SAMPLINGS, default='uniform', help='see below (default uniform)'
    )
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
        RunError: a push does not stay on the face.
    """
    check_range('--pushes', arguments.pushes, 1, 10**7)
    check_seed(arguments.seed)
    check_jobs(arguments.jobs)
    check_place(arguments.output)
    pushes = collect(
        arguments.pushes,
        arguments.seed,
        arguments.profile,
        PushDesign(speed=arguments.speed, duration=arguments.duration),
        arguments.jobs,
        arguments.sampling,
    )
    write_pushes(arguments.output, pushes)
    sys.stdout.write(f'{len(pushes)} pushes in {arguments.output}\n')


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command."""
    return run_command(parser(), work, argv)


if __name__ == '__main__':
    raise SystemExit(main())
