"""`mpc_node` with a QP solver that fails on request."""

import sys
import time
from pkgutil import resolve_name
from typing import Any

import numpy as np
from push_core.physics import Slider
from push_mpc.loop import tracker
from push_mpc.qp import Move, Steering
from push_mpc.settings import ControllerSettings

from push_bringup.faults.sick.ailment import ailment
from push_bringup.graph import MODULES

SLOW = 0.02  # [s]
_INFEASIBLE, _ITERATION_LIMIT = 3, 7
_make = tracker.made_steering


class SickSteering:
    """A `Steering` that does what `ailment` says."""

    def __init__(self, healthy: Steering) -> None:
        self._healthy = healthy

    def __getattr__(self, name: str) -> Any:
        return getattr(self._healthy, name)

    def solve(self, *arguments: Any) -> Move:
        """See `Steering.solve`."""
        how = ailment()
        if how == 'raises':
            raise ArithmeticError('the solver raised')
        if how == 'slow':
            time.sleep(SLOW)
        move = self._healthy.solve(*arguments)
        status = {'infeasible': _INFEASIBLE, 'unfinished': _ITERATION_LIMIT}.get(how)
        if status is None:
            return move
        return Move(np.full(2, np.nan), status, move.iterations, 'asked to fail', move.states)


def _sick(settings: ControllerSettings, slider: Slider, speed: float) -> Any:
    return SickSteering(_make(settings, slider, speed))


if __name__ == '__main__':
    tracker.made_steering = _sick
    sys.exit(resolve_name(f'{MODULES["mpc_node"]}:main')())
