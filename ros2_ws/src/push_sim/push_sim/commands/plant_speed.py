"""How fast the plant is, in processor time of this process, and whether it keeps its memory.

Processor time does not count what other processes take; it still grows a little beside them.
"""

import math
import resource
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from push_core.physics import Slider

from push_sim.collect import Collector, PushDesign, uniform
from push_sim.plant import Plant
from push_sim.settings import PERIOD, SimSettings

_PERIODS = 200
_PUSHES = 100
_REPEATS = 5
_WARM_UP = 200
_MEGABYTE = 1e6


def real_time_factor(settings: SimSettings, slider: Slider) -> float:
    """Seconds of a weaving push that the plant advances in a second; the best of a few."""
    plant = Plant(settings, slider)
    seconds = min(_seconds(lambda: _weave(plant, slider)) for _ in range(_REPEATS))
    plant.close()
    return _PERIODS * PERIOD / seconds


def pushes_per_second(settings: SimSettings, slider: Slider) -> float:
    """Pushes that are collected in a second by one process; the best of a few."""
    design = PushDesign()
    aim = uniform(design, slider.side, _PUSHES)
    with Collector(settings, slider, design, aim) as collector:

        def collect() -> None:
            for number in range(_PUSHES):
                collector.push(0, number)

        return _PUSHES / min(_seconds(collect) for _ in range(_REPEATS))


def memory_growth(settings: SimSettings, slider: Slider, resets: int) -> float:
    """Growth [MB] of this process's resident memory over some resets, after a first few."""
    plant = Plant(settings, slider)
    pose, tip = np.zeros(3), slider.tip_position(np.zeros(3), 0.0)

    def reset(first: int, last: int) -> None:
        for seed in range(first, last):
            plant.reset(pose, tip, seed)
            plant.step()

    reset(0, _WARM_UP)
    before = _resident_memory()
    reset(_WARM_UP, _WARM_UP + resets)
    grown = _resident_memory() - before
    plant.close()
    return grown / _MEGABYTE


def _weave(plant: Plant, slider: Slider) -> None:
    plant.reset(np.zeros(3), slider.tip_position(np.zeros(3), 0.01), 0)
    for tick in range(_PERIODS):
        plant.command(np.array([0.08, 0.02 * math.sin(0.1 * tick)]), plant.time)
        plant.step()


def _seconds(work: Callable[[], None]) -> float:
    start = time.process_time()
    work()
    return time.process_time() - start


def _resident_memory() -> int:
    """In bytes."""
    pages = int(Path('/proc/self/statm').read_text(encoding='ascii').split()[1])
    return pages * resource.getpagesize()
