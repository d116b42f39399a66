"""`ros2 run push_bringup bench timing`: the controller's quadratic programs, by every solver."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from push_core.common import Parser, run_command, write_atomically
from push_core.geometry import Array
from push_mpc.qp import NX, Problem
from tqdm import tqdm

from push_bringup.bench.options import add_controller, print_found
from push_bringup.bench.rows import SolverRow
from push_bringup.rivals import IN_SI_UNITS, SOLVERS, Solver, exact, recorded
from push_bringup.setup import model_for

Tick = tuple[Problem, ...]
SPEED_UNIT = 1e-2  # [m/s]; of every input in our set-up, of forces by the speed they make
EPILOG = """The programs are recorded from one lap of the 8-track at 80 mm/s with a kick every 4 s.
The Family of Modes (analytical) has three in each tick, whose times add up. Times are CPU time of
the one thread, for putting the numbers in and solving; the first program of each, which sets a
solver up, is left out. The error is that of the first input against OSQP at 1e-9.
What is not installed is named: `make setup EXTRA=bench` installs all.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Solves the quadratic programs of a lap by every solver.', EPILOG)
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
    ticks = recorded(arguments.controller, model, arguments.seed)
    rows = list(_rows(ticks))
    found = {
        'controller': arguments.controller,
        'ticks': len(ticks),
        'solvers': [row.as_json() for row in rows],
    }
    print_found(arguments, 'timing', found)
    if arguments.html:
        # plotly takes a second to import: only who asks for a figure waits for it
        from push_bringup.bench.timing_page import timing_page  # noqa: PLC0415

        write_atomically(arguments.html, timing_page(rows).encode())
    return 0


@dataclass(frozen=True)
class _Solved:
    """One tick: CPU time [s], iterations, and the first inputs of its programs, in SI units."""

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
    """Solves all ticks, each program of a tick by a solver of its own."""
    in_si_units = name in IN_SI_UNITS
    solvers = [make(problem) for problem in ticks[0]]
    for tick in tqdm(ticks, desc=name, unit=' ticks', disable=None):
        given = [problem.in_si_units() if in_si_units else problem for problem in tick]
        started = time.thread_time()
        answers = [solver.solve(each) for solver, each in zip(solvers, given, strict=True)]
        seconds = time.thread_time() - started
        inputs = [
            _first_inputs(problem, found * problem.units[0])
            for problem, (found, _) in zip(given, answers, strict=True)
        ]
        yield _Solved(seconds, sum(count for _, count in answers), np.array(inputs))


def _first_inputs(problem: Problem, variables: Array) -> Array:
    """Those of the first stage (m,)."""
    stages = problem.states // NX - 1
    return variables[problem.states : problem.states + (variables.size - problem.states) // stages]


if __name__ == '__main__':
    sys.exit(main())
