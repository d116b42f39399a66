"""Recorded commands beside those that a controller computes from the recorded poses.

This package knows messages, not controllers. Who knows one offers it as the entry point RECOMPUTE
of its package: a function of a bag's path and the `Changes` that gives the `Recomputed` run.
"""

from dataclasses import dataclass, field
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError

from push_bag.run import Floats, Nanoseconds

RECOMPUTE = 'push_bag.recompute'


@dataclass(frozen=True)
class Changes:
    """What shall differ from the recorded run.

    Attributes:
        controller: gp or analytical; empty for the recorded one.
        model: path of a model file; None for that of the bag.
        params: parameters by NAME or NODE.NAME.
    """

    controller: str = ''
    model: Path | None = None
    params: dict[str, object] = field(default_factory=dict)

    @property
    def any(self) -> bool:
        """Whether anything differs."""
        return bool(self.controller or self.model or self.params)


@dataclass(frozen=True)
class Recomputed:
    """Commands of a run, recorded and computed again, tick by tick.

    Attributes:
        stamp: (n,) of the commands [ns].
        recorded: (n, 2) velocities in the world frame [m/s].
        computed: (n, 2) the same, computed from the recorded poses.
        skipped: commands that could not be computed, because their poses are not in the bag.
    """

    stamp: Nanoseconds
    recorded: Floats
    computed: Floats
    skipped: int

    @property
    def differs(self) -> NDArray[np.bool_]:
        """Whether each command (n,) differs in any bit."""
        recorded, computed = (
            np.ascontiguousarray(each).view(np.uint64) for each in (self.recorded, self.computed)
        )
        return np.asarray((recorded != computed).any(axis=1))

    @property
    def same(self) -> bool:
        """Whether all commands were computed, and are the same bit for bit."""
        return not (self.skipped or self.differs.any())

    def text(self) -> str:
        """Lines for a person."""
        differs, count = self.differs, self.stamp.size
        lines = [f'{count - differs.sum()} of {count} commands are the same, bit for bit']
        if differs.any():
            lines.append(self._difference_text())
        if self.skipped:
            lines.append(f'{self.skipped} commands not computed: the bag has no poses for them')
        return '\n'.join(lines) + '\n'

    def _difference_text(self) -> str:
        away = 1e3 * np.hypot(*(self.computed - self.recorded).T)
        worst = int(np.argmax(away))
        first = (self.stamp[int(np.argmax(self.differs))] - self.stamp[0]) * 1e-9
        at = (self.stamp[worst] - self.stamp[0]) * 1e-9
        rms = float(np.sqrt(np.mean(away**2)))
        median, p99 = np.percentile(away, (50, 99)).tolist()
        return (
            f'difference: rms {rms:.3g}, median {median:.3g}, p99 {p99:.3g}, '
            f'largest {away[worst]:.3g} mm/s at {at:.2f} s, first at {first:.2f} s'
        )


def recomputed(run: Path, changes: Changes) -> Recomputed:
    """The commands of a run, computed again by the controller that is installed.

    Raises:
        InputError: no controller is installed, or the bag lacks what it needs.
    """
    engines = list(entry_points(group=RECOMPUTE))
    if not engines:
        raise InputError('no controller is installed; build and source push_bringup')
    compute: Any = engines[0].load()
    found: Recomputed = compute(run, changes)
    return found
