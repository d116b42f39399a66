"""`bench timing`: the controller's QPs by every solver."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from push_core.common import InterruptsHeld, Parser, run_command, write_atomically
from push_core.geometry import Array
from push_mpc.qp import NX, Problem
from tqdm import tqdm

from push_bringup.bench.options import add_controller, print_results
from push_bringup.bench.rows import SolverRow
from push_bringup.comparison import IN_SI_UNITS, SOLVERS, Solver, exact, recorded_problems
from push_bringup.setup import model_for

Tick = tuple[Problem, ...]
SPEED_UNIT = 1e-2  # [m/s]; the unit of every input in the QP, for forces that of their motion
EPILOG = """The QPs are recorded from one lap of the 8-track at 80 mm/s with a kick every 4 s. The
Family of Modes (analytical) solves three in each tick; their times add up. Times are CPU time of
one thread for update and solve, without the first QP, which sets the solver up. The error is that
of the first input against OSQP with a tolerance of 1e-9.
`make setup EXTRA=bench` installs all solvers; missing ones are named.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Solves the QPs of a lap by every solver.', EPILOG)
    described.prog = 'bench timing'
    add_controller(described)
    described.add_argument('--seed', type=int, default=0, help="of the plant's noise (default 0)")
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    described.add_argument('--html', type=Path, metavar='FILE', help='draw the times as well')
    return described


def work(arguments: argparse.Namespace) -> int:
    """Records, solves and prints.

    Raises:
        InputError: the model cannot be read.
    """
    model = model_for(arguments.controller, arguments.model)
    ticks = recorded_problems(arguments.controller, model, arguments.seed)
    rows = list(_rows(ticks))
    results = {
        'controller': arguments.controller,
        'ticks': len(ticks),
        'solvers': [row.as_json() for row in rows],
    }
    print_results(arguments, 'timing', results)
    if arguments.html:
        # plotly takes a second to import: only a page needs it
        from push_bringup.bench.solver_times_page import solver_times_page  # noqa: PLC0415

        write_atomically(arguments.html, solver_times_page(rows).encode())
    return 0


@dataclass(frozen=True)
class _Solved:
    """One tick: CPU time [s], iterations, and the first inputs of its QPs in SI units."""

    seconds: float
    iterations: int
    first_inputs: Array


def _rows(ticks: Sequence[Tick]) -> Iterator[SolverRow]:
    expected = [solved.first_inputs for solved in _solved('exact', exact, ticks)]
    missing = []
    for name, make in SOLVERS.items():
        try:
            solved = list(_solved(name, make, ticks))
        except ImportError:
            missing.append(name)
            continue
        yield _row(name, solved, expected, ticks[0])
    if missing:
        sys.stderr.write(
            f'not installed: {", ".join(missing)}; make setup EXTRA=bench installs them\n'
        )


def _row(
    name: str, solved: Sequence[_Solved], expected: Sequence[Array], first: Tick
) -> SolverRow:
    unit = np.array([_first_inputs(problem, problem.units[0]) for problem in first])
    pairs = zip(solved, expected, strict=True)
    error = max(float(np.max(np.abs(one.first_inputs - right) / unit)) for one, right in pairs)
    times = np.array([1e3 * one.seconds for one in solved[1:]])
    return SolverRow(name, times, max(one.iterations for one in solved), SPEED_UNIT * error)


def _solved(
    name: str, make: Callable[[Problem], Solver], ticks: Sequence[Tick]
) -> Iterator[_Solved]:
    """Solves all ticks, each QP of a tick by its own solver."""
    in_si_units = name in IN_SI_UNITS
    solvers = [make(problem) for problem in ticks[0]]
    for tick in tqdm(ticks, desc=name, unit=' ticks', disable=None):
        given = [problem.in_si_units() if in_si_units else problem for problem in tick]
        with InterruptsHeld():  # OSQP has a handler of its own
            started = time.thread_time()
            solutions = [solver.solve(each) for solver, each in zip(solvers, given, strict=True)]
            seconds = time.thread_time() - started
        inputs = [
            _first_inputs(problem, variables * problem.units[0])
            for problem, (variables, _) in zip(given, solutions, strict=True)
        ]
        yield _Solved(seconds, sum(count for _, count in solutions), np.array(inputs))


def _first_inputs(problem: Problem, variables: Array) -> Array:
    """The inputs of the first stage (m,)."""
    stages = problem.states // NX - 1
    return variables[problem.states : problem.states + (variables.size - problem.states) // stages]


if __name__ == '__main__':
    sys.exit(main())
