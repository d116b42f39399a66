"""Recorded commands compared with those that a controller computes from the recorded poses.

This package does not depend on controllers. The one that does offers the entry point RECOMPUTE: a
function from the path of a bag and `Changes` to a `Recomputed` run; and QP, from the path of a bag
and the number of a tick to a text about its QPs.
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
QP = 'push_bag.qp'


@dataclass(frozen=True)
class Changes:
    """Changes to the recorded run.

    Attributes:
        controller: name of a controller; empty for the recorded one.
        model: path of a model file; None for the model in the bag.
        params: values of parameters by NAME or NODE.NAME.
    """

    controller: str = ''
    model: Path | None = None
    params: dict[str, object] = field(default_factory=dict)

    @property
    def any(self) -> bool:
        """Whether there is any change."""
        return bool(self.controller or self.model or self.params)


@dataclass(frozen=True)
class Recomputed:
    """Recorded and recomputed commands of a run.

    Attributes:
        stamp: (n,) of the commands [ns].
        recorded: (n, 2) velocities in the world frame [m/s].
        computed: (n, 2) velocities computed from the recorded poses [m/s].
        skipped: number of commands that were not computed because the bag lacks their poses.
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
        """Whether all commands were computed and are equal bit for bit."""
        return not (self.skipped or self.differs.any())

    def text(self) -> str:
        """The comparison as lines of text."""
        differs, count = self.differs, self.stamp.size
        lines = [f'{count - differs.sum()} of {count} commands are the same, bit for bit']
        if differs.any():
            lines.append(self._difference_text())
        if self.skipped:
            lines.append(f'{self.skipped} commands not computed: the bag lacks their poses')
        return '\n'.join(lines) + '\n'

    def _difference_text(self) -> str:
        size = 1e3 * np.hypot(*(self.computed - self.recorded).T)
        worst = int(np.argmax(size))
        first = (self.stamp[int(np.argmax(self.differs))] - self.stamp[0]) * 1e-9
        at = (self.stamp[worst] - self.stamp[0]) * 1e-9
        rms = float(np.sqrt(np.mean(size**2)))
        median, p99 = np.percentile(size, (50, 99)).tolist()
        return (
            f'difference: rms {rms:.3g}, median {median:.3g}, p99 {p99:.3g}, '
            f'largest {size[worst]:.3g} mm/s at {at:.2f} s, first at {first:.2f} s'
        )


def recomputed(run: Path, changes: Changes) -> Recomputed:
    """Recomputes the commands of a run with the installed controller.

    Raises:
        InputError: no controller is installed, or the bag lacks what it needs.
    """
    result: Recomputed = _engine(RECOMPUTE)(run, changes)
    return result


def solved_again(run: Path, tick: int) -> str:
    """The QPs of a tick, solved again with the installed controller's solver, in words.

    Args:
        run: run folder or MCAP file.
        tick: its number in `controller_state`.

    Raises:
        InputError: no controller is installed, or the bag lacks what it needs.
    """
    return str(_engine(QP)(run, tick))


def _engine(group: str) -> Any:
    engines = list(entry_points(group=group))
    if not engines:
        raise InputError('no controller is installed; build and source push_bringup')
    return engines[0].load()
