"""Solves the QPs of one recorded tick again: why did the solver fail there?

The bag holds all that the commands depend on, so that the run is computed again up to the tick.
"""

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import osqp
from push_bag.replay import Changes
from push_core.common import InputError
from push_mpc.loop import Mode
from push_mpc.qp import OSQP_SETTINGS, Problem
from scipy import sparse

from push_bringup.in_process.recompute import opened

ACCURATE = {'eps_abs': 1e-9, 'eps_rel': 1e-9, 'max_iter': 100_000, 'scaling': 10}


def qp_text(path: Path, number: int) -> str:
    """What the QPs of a tick are, and what a solver says about them.

    Args:
        path: run folder or MCAP file.
        number: of the tick, as in `controller_state`.

    Raises:
        InputError: the bag lacks parameters, model or track, or has no such tick with a QP.
    """
    run, controller, paired = opened(path, Changes())
    for tick in run.ticks(paired):
        if tick.number == number:
            controller.answer(tick)
            break
        controller.command_at(tick)
    else:
        raise InputError(f'{path} has no tick {number}')
    problems = controller.problems
    if tick.mode in (Mode.IDLE, Mode.ARMED) or math.isnan(tick.exposure):
        raise InputError(f'tick {number} of {path} is one without a QP')
    lines = [f'tick {number}: {Mode(tick.mode).name}' + _because(tick.stop_reason)]
    for count, problem in enumerate(problems, start=1):
        rows, size = problem.matrix.shape
        lines.append(f'QP {count} of {len(problems)}: {size} variables, {rows} constraints')
        lines.append(f'  as the controller solves it: {_solved(problem, OSQP_SETTINGS)}')
        lines.append(f'  to 1e-9: {_solved(problem, {**OSQP_SETTINGS, **ACCURATE})}')
    return '\n'.join([*lines, ''])


def _because(reason: str) -> str:
    return f', {reason}' if reason else ''


def _solved(problem: Problem, settings: Mapping[str, object]) -> str:
    """Status, iterations and largest violation of a cold solve, in words."""
    solver = osqp.OSQP()
    cost = sparse.csc_matrix(sparse.triu(problem.cost))
    solver.setup(cost, problem.linear, problem.matrix, problem.low, problem.high, **settings)
    result = solver.solve(raise_error=False)
    told = f'{result.info.status}, {result.info.iter} iterations'
    if not np.isfinite(result.x).all():
        return told
    rows = problem.matrix @ result.x
    excess = np.maximum(problem.low - rows, rows - problem.high)
    worst = int(np.argmax(excess))
    kind = 'dynamics' if worst < problem.states else 'limits'
    return f'{told}, largest violation {max(excess[worst], 0.0):.3g} (row {worst}, {kind})'
