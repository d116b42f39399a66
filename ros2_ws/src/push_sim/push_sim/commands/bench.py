"""The command that measures the plant itself: `ros2 run push_sim bench`."""

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace

from push_core.common import InputError, Parser, json_text, run_command
from push_core.physics import Slider

from push_sim.commands.plant_speed import memory_growth, pushes_per_second, real_time_factor
from push_sim.settings import ENGINES, PROFILES, profile

_MOST_RESETS = 10**7

EPILOG = """real_time_factor  seconds of pushing that the plant advances in one of processor time
pushes_per_s      pushes that `collect` makes in a second of processor time, on one core
memory_growth_mb  growth of the resident memory over N resets, each with one period of 10 ms

examples:
  ros2 run push_sim bench
  ros2 run push_sim bench --resets 100000 --json
"""


def parser() -> Parser:
    """Describes the command line."""
    described = Parser('Measures how fast the plant is and whether it keeps its memory.', EPILOG)
    described.add_argument('--profile', choices=PROFILES, default='irb120')
    described.add_argument('--engine', choices=ENGINES, default='bullet')
    described.add_argument(
        '--resets', type=int, default=2000, metavar='N', help='how many (default %(default)s)'
    )
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    return described


def work(arguments: argparse.Namespace) -> None:
    """Measures and reports.

    Raises:
        InputError: a number is out of its range.
    """
    if not 1 <= arguments.resets <= _MOST_RESETS:
        raise InputError(f'--resets is {arguments.resets}, must be between 1 and {_MOST_RESETS}')
    settings, slider = profile(arguments.profile), Slider()
    settings = replace(settings, world=replace(settings.world, engine=arguments.engine))
    figures = {
        'profile': arguments.profile,
        'engine': arguments.engine,
        'real_time_factor': real_time_factor(settings, slider),
        'pushes_per_s': pushes_per_second(settings, slider),
        'resets': arguments.resets,
        'memory_growth_mb': memory_growth(settings, slider, arguments.resets),
    }
    sys.stdout.write(json_text(figures) if arguments.json else _table(figures))


def _table(figures: dict[str, str | int | float]) -> str:
    rows = [
        f'{name:18}{value:.4g}' if isinstance(value, float) else f'{name:18}{value}'
        for name, value in figures.items()
    ]
    return '\n'.join(rows) + '\n'


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command."""
    return run_command(parser(), work, argv)


if __name__ == '__main__':
    raise SystemExit(main())
