"""Repeats measured pushes and robot runs in a simulated world, in several processes."""

from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from push_core.common import Map
from push_core.data import LongPushes, PushSet
from push_core.geometry import Array
from push_core.physics import Slider
from tqdm import tqdm

from push_sim.collect import PushTiming, execute_push, push_row
from push_sim.measured.run_windows import INTERVAL, Windows
from push_sim.settings import WorldSettings
from push_sim.worlds import COARSE_SUBSTEP, make_coarse_world
from push_sim.worlds.common import World

ProgressBar: TypeAlias = 'tqdm[Any]'

_CHUNK = 120
# speed [m/s] of the tip where the file does not state it: 0.1 mm in a time step
_SPEED = 0.02
# some measured tips start inside the square, by up to 0.4 mm
_RETREAT = 0.002


@dataclass(frozen=True)
class Replay:
    """Repeats measurements in any world and counts them on a progress bar.

    Attributes:
        slider: nominal slider of the world.
        run_in: maps a function over tasks, in processes.
        bar: progress bar.
    """

    slider: Slider
    run_in: Map
    bar: ProgressBar

    def short(self, world: WorldSettings, pushes: PushSet) -> Array:
        """Simulated displacements (n, 3) [m, m, rad] of short pushes."""
        function = partial(replay_short_pushes, distance=pushes.distance)
        return self._replayed(function, world, pushes.inputs)

    def long(self, world: WorldSettings, pushes: LongPushes) -> Array:
        """Simulated end poses (n, 3) [m, m, rad] of long pushes."""
        columns = (pushes.start, pushes.tip_start, pushes.tip_end)
        return self._replayed(replay_long_pushes, world, *columns)

    def windows(self, world: WorldSettings, windows: Windows) -> Array:
        """Simulated end poses (n, 3) [m, m, rad] of the windows of a run."""
        return self._replayed(replay_windows, world, windows.start, windows.tip)

    def _replayed(
        self, function: Callable[..., Array], world: WorldSettings, *columns: Array
    ) -> Array:
        """The results of a function for all rows, computed in chunks."""
        firsts = range(0, len(columns[0]), _CHUNK)
        chunks = ([column[first : first + _CHUNK] for column in columns] for first in firsts)
        parts = []
        for part in self.run_in(function, ((world, self.slider, *chunk) for chunk in chunks)):
            self.bar.update(len(part))
            parts.append(part)
        return np.concatenate(parts)


def replay_short_pushes(
    settings: WorldSettings, slider: Slider, inputs: Array, distance: float
) -> Array:
    """Simulates short pushes from their contact offset and direction.

    The measurement begins with settled contact. The simulated contact settles within the first
    time step: pushing for up to 0.1 s before changes the mean NMSE by less than 0.001.

    Args:
        settings: parameters of the world.
        slider: nominal slider.
        inputs: (n, 2) contact offset p_y [m] and direction beta [rad] at the start of each push.
        distance: travel of the tip in each push [m].

    Returns:
        (n, 3) dx_b [m], dy_b [m], dtheta [rad] in the body frame at the start of each push.
    """
    steps = max(1, round(distance / (_SPEED * COARSE_SUBSTEP)))
    timing = PushTiming(distance / (steps * COARSE_SUBSTEP), 0, steps)
    with closing(make_coarse_world(settings, slider)) as world:
        rows = [push_row(slider, *execute_push(world, slider, timing, *row)) for row in inputs]
    return np.reshape(rows, (-1, 5))[:, 2:]


def replay_long_pushes(
    settings: WorldSettings, slider: Slider, start: Array, tip_start: Array, tip_end: Array
) -> Array:
    """Simulates straight pushes with the measured start and end of the tip.

    Args:
        settings: parameters of the world.
        slider: nominal slider.
        start: (n, 3) object poses before [m, m, rad].
        tip_start: (n, 2) tip positions before [m].
        tip_end: (n, 2) tip positions after [m].

    Returns:
        (n, 3) object poses after [m, m, rad].
    """
    with closing(make_coarse_world(settings, slider)) as world:
        ends = [_long_end(world, *row) for row in zip(start, tip_start, tip_end, strict=True)]
    return np.reshape(ends, (-1, 3))


def _long_end(world: World, start: Array, tip_start: Array, tip_end: Array) -> Array:
    travel = tip_end - tip_start
    begin = tip_start - _RETREAT * travel / np.linalg.norm(travel)
    steps = max(1, round(float(np.linalg.norm(tip_end - begin)) / (_SPEED * COARSE_SUBSTEP)))
    x, y = ((tip_end - begin) / (steps * COARSE_SUBSTEP)).tolist()
    world.reset(start, begin)
    world.advance((x, y), steps)
    return world.object_pose


def replay_windows(settings: WorldSettings, slider: Slider, start: Array, tip: Array) -> Array:
    """Simulates the windows of a robot run: the tip moves as sensed, the object is free.

    Args:
        settings: parameters of the world.
        slider: nominal slider.
        start: (n, 3) object poses at the starts of the windows [m, m, rad].
        tip: (n, k, 2) tip positions, every `INTERVAL` [m].

    Returns:
        (n, 3) object poses at the ends of the windows [m, m, rad].
    """
    with closing(make_coarse_world(settings, slider)) as world:
        ends = [_window_end(world, *row) for row in zip(start, tip, strict=True)]
    return np.reshape(ends, (-1, 3))


def _window_end(world: World, start: Array, tip: Array) -> Array:
    world.reset(start, tip[0])
    for x, y in (np.diff(tip, axis=0) / INTERVAL).tolist():
        world.advance((x, y), round(INTERVAL / COARSE_SUBSTEP))
    return world.object_pose
