"""Everything that was measured, made again in one world, in several processes."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from push_core.common import Map
from push_core.data import LongPushes, PushSet
from push_core.geometry import Array
from push_core.physics import Slider
from tqdm import tqdm

from push_sim.measured.replay_long import replay_long
from push_sim.measured.replay_run import replay_run
from push_sim.measured.replay_short import replay_short
from push_sim.measured.run_windows import Windows
from push_sim.settings import WorldSettings

Bar: TypeAlias = 'tqdm[Any]'

_CHUNK = 120


@dataclass(frozen=True)
class Replay:
    """Makes measured pushes again; counts them on a bar.

    Attributes:
        slider: what is pushed.
        run_in: the processes.
        bar: shows the progress.
    """

    slider: Slider
    run_in: Map
    bar: Bar

    def short(self, world: WorldSettings, pushes: PushSet) -> Array:
        """Displacements (n, 3) [m, m, rad] of short pushes."""
        tasks = (
            (world, self.slider, pushes.inputs[rows], pushes.distance)
            for rows in _chunks(len(pushes))
        )
        return self._gathered(self.run_in(replay_short, tasks))

    def long(self, world: WorldSettings, pushes: LongPushes) -> Array:
        """End poses (n, 3) [m, m, rad] of long pushes."""
        columns = (pushes.start, pushes.tip_start, pushes.tip_end)
        tasks = (
            (world, self.slider, *(column[rows] for column in columns))
            for rows in _chunks(len(pushes))
        )
        return self._gathered(self.run_in(replay_long, tasks))

    def windows(self, world: WorldSettings, cut: Windows) -> Array:
        """End poses (n, 3) [m, m, rad] of the windows of a run."""
        return self._gathered(self.run_in(replay_run, [(world, self.slider, cut)]))

    def _gathered(self, chunks: Iterator[Array]) -> Array:
        parts = []
        for part in chunks:
            self.bar.update(len(part))
            parts.append(part)
        return np.concatenate(parts)


def _chunks(count: int) -> Iterator[NDArray[np.intp]]:
    rows = np.arange(count)
    return (rows[first : first + _CHUNK] for first in range(0, count, _CHUNK))
