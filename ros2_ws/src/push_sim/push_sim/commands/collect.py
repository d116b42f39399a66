"""Collects simulated pushes: `ros2 run push_sim collect`."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import Parser, check_place, run_command
from push_core.data import write_pushes

from push_sim.collect import SAMPLINGS, PushDesign, collect_pushes
from push_sim.commands.command_checks import check_jobs, check_range, check_seed
from push_sim.settings import PROFILES

EPILOG = """contact offsets and directions (--sampling):
  uniform   random over 95 % of the face and directions up to 84 degrees from the normal
  grid      centres of k x k cells over both; N must be a square number
  die       five pushes, repeated: the middle of the face along the normal, and half-way to each
            end 30 degrees to either side

examples:
  ros2 run push_sim collect --pushes 5000 -o pushes.csv
  ros2 run push_sim collect --pushes 5 --sampling die --profile ideal -o five.csv
  ros2 run push_sim collect --pushes 400 --sampling grid --speed 0.05 --duration 0.1 -o fast.csv
"""


def parser() -> Parser:
    """Describes the command line."""
    design = PushDesign()
    described = Parser('Simulates short straight pushes and writes them to a CSV file.', EPILOG)
    described.add_argument('--pushes', type=int, required=True, metavar='N', help='number')
    described.add_argument('-o', '--output', type=Path, required=True, metavar='FILE')
    described.add_argument('--seed', type=int, default=0, help='of all random numbers (default 0)')
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
    pushes = collect_pushes(
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
