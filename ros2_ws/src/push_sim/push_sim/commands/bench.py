"""Measures speed and memory of the plant: `ros2 run push_sim bench`."""

import argparse
import math
import sys
import time
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from resource import getpagesize

import numpy as np
from push_core.common import Parser, json_text, plain_table, replaced, run_command
from push_core.physics import Slider

from push_sim.collect import Collector, PushDesign, uniform
from push_sim.commands.command_checks import check_range
from push_sim.plant import Plant
from push_sim.settings import ENGINE_NAMES, PERIOD, PROFILES, SimSettings, profile

_PERIODS = 200
_PUSHES = 100
_REPEATS = 5
_WARM_UP_RESETS = 200

EPILOG = """real_time_factor  simulated seconds of pushing for each second of processor time
pushes_per_s      pushes that `collect` makes in a second of processor time, on one core
memory_growth_mb  growth of the resident memory over N resets, each with one period of 10 ms

Times are the best of five. Processor time does not count other processes, but it grows a little
on a busy machine.

examples:
  ros2 run push_sim bench
  ros2 run push_sim bench --resets 100000 --json
"""


def real_time_factor(settings: SimSettings, slider: Slider) -> float:
    """Simulated seconds of a push for each second of processor time."""
    plant = Plant(settings, slider)
    seconds = _best_seconds(lambda: _push(plant, slider))
    plant.close()
    return _PERIODS * PERIOD / seconds


def pushes_per_second(settings: SimSettings, slider: Slider) -> float:
    """Collected pushes for each second of processor time, in one process."""
    design = PushDesign()
    sampler = uniform(design, slider.side, _PUSHES)
    with closing(Collector(settings, slider, design, sampler)) as collector:

        def collect() -> None:
            for number in range(_PUSHES):
                collector.push(0, number)

        return _PUSHES / _best_seconds(collect)


def memory_growth(settings: SimSettings, slider: Slider, resets: int) -> float:
    """Growth [MB] of the resident memory of this process over some resets, after a warm-up."""
    plant = Plant(settings, slider)
    pose, tip = np.zeros(3), slider.tip_position(np.zeros(3), 0.0)

    def reset(first: int, last: int) -> None:
        for seed in range(first, last):
            plant.reset(pose, tip, seed)
            plant.step()

    reset(0, _WARM_UP_RESETS)
    before = _resident_megabytes()
    reset(_WARM_UP_RESETS, _WARM_UP_RESETS + resets)
    growth = _resident_megabytes() - before
    plant.close()
    return growth


def _push(plant: Plant, slider: Slider) -> None:
    """A push with a tangential velocity that changes sign."""
    plant.reset(np.zeros(3), slider.tip_position(np.zeros(3), 0.01), 0)
    for tick in range(_PERIODS):
        plant.command(np.array([0.08, 0.02 * math.sin(0.1 * tick)]), plant.time)
        plant.step()


def _best_seconds(work: Callable[[], None]) -> float:
    times = []
    for _ in range(_REPEATS):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def _resident_megabytes() -> float:
    # proc(5): the second number of statm is the resident set in pages; getrusage knows the peak
    pages = int(Path('/proc/self/statm').read_text(encoding='ascii').split()[1])
    return pages * getpagesize() / 1e6


def parser() -> Parser:
    """Describes the command line."""
    described = Parser('Measures speed and memory of the plant.', EPILOG)
    described.add_argument('--profile', choices=PROFILES, default='irb120', help='of the plant')
    described.add_argument('--engine', choices=ENGINE_NAMES, default='bullet', help='physics')
    described.add_argument(
        '--resets', type=int, default=2000, metavar='N', help='number (default %(default)s)'
    )
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    return described


def work(arguments: argparse.Namespace) -> None:
    """Measures and prints.

    Raises:
        InputError: a number is out of its range.
    """
    check_range('--resets', arguments.resets, 1, 10**7)
    slider = Slider()
    settings = replaced(profile(arguments.profile), {'world.engine': arguments.engine})
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
        (name, f'{value:.4g}' if isinstance(value, float) else str(value))
        for name, value in figures.items()
    ]
    return '\n'.join([*plain_table(rows), ''])


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command."""
    return run_command(parser(), work, argv)


if __name__ == '__main__':
    raise SystemExit(main())
