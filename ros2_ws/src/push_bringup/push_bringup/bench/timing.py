"""`ros2 run push_bringup bench timing`: the controller's quadratic programs, by every solver."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from push_core.common import Parser, json_text, run_command, write_atomically
from push_core.geometry import Array
from push_gp.models import ANALYTICAL
from push_mpc.qp import NX, Problem
from tqdm import tqdm

from push_bringup.rivals import IN_SI_UNITS, SOLVERS, Solver, exact, recorded
from push_bringup.setup import default_model

Tick = tuple[Problem, ...]
SPEED_UNIT = 1e-2  # [m/s]; of every input in our set-up, of forces by the speed they make
EPILOG = """The programs are recorded from one lap of the 8-track at 80 mm/s with a kick every 4 s.
The Family of Modes (analytical) has three in each tick, whose times add up. Times are CPU time of
the one thread, for putting the numbers in and solving; the first program of each, which sets a
solver up, is left out. The error is that of the first input against OSQP at 1e-9.
What is not installed is named: `make setup EXTRA=bench` installs all.
"""


@dataclass(frozen=True)
class Timing:
    """How one solver did over all ticks.

    Attributes:
        name: of the solver.
        milliseconds: each tick took (n,).
        iterations_max: of a tick.
        first_input_error: largest one [m/s].
    """

    name: str
    milliseconds: Array
    iterations_max: int
    first_input_error: float

    def as_json(self) -> dict[str, object]:
        """The solver's entry of `bench timing --json`."""
        p50, p99, p999 = np.percentile(self.milliseconds, [50.0, 99.0, 99.9])
        return {
            'name': self.name,
            'p50_ms': p50,
            'p99_ms': p99,
            'p999_ms': p999,
            'max_ms': self.milliseconds.max(),
            'iterations_max': self.iterations_max,
            'first_input_error_m_s': self.first_input_error,
        }


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Solves the quadratic programs of a lap by every solver.', EPILOG)
    described.prog = 'bench timing'
    described.add_argument('--controller', choices=('gp', 'analytical'), default='gp')
    described.add_argument(
        '--model', metavar='FILE', help='of the gp controller; default: 200 simulated pushes'
    )
    described.add_argument('--seed', type=int, default=0, help="of the plant's noise (default 0)")
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    described.add_argument('--html', type=Path, metavar='FILE', help='draw the times as well')
    return described


def work(arguments: argparse.Namespace) -> int:
    """Records, solves and prints.

    Raises:
        InputError: the model cannot be read.
    """
    model = ANALYTICAL
    if arguments.controller == 'gp':
        model = arguments.model or str(default_model())
    ticks = recorded(arguments.controller, model, arguments.seed)
    timings = list(_timings(ticks))
    if arguments.json:
        solvers = [timing.as_json() for timing in timings]
        told = {'controller': arguments.controller, 'ticks': len(ticks), 'solvers': solvers}
        sys.stdout.write(json_text(told))
    else:
        sys.stdout.write(table(timings))
    if arguments.html:
        # plotly takes a second to import: only who asks for a figure waits for it
        from push_bringup.bench.timing_page import timing_page  # noqa: PLC0415

        write_atomically(arguments.html, timing_page(timings).encode())
    return 0


def table(timings: Sequence[Timing]) -> str:
    """The solvers as a Markdown table."""
    head = '| solver | p50 | p99 | p99.9 | max | iterations | first input |\n'
    lines = []
    for timing in timings:
        row = timing.as_json()
        times = ' | '.join(
            f'{row[key]:.2f} ms' for key in ('p50_ms', 'p99_ms', 'p999_ms', 'max_ms')
        )
        lines.append(
            f'| {timing.name} | {times} | {timing.iterations_max} '
            f'| {timing.first_input_error:.1e} m/s |\n'
        )
    return head + '|---|---|---|---|---|---|---|\n' + ''.join(lines)


@dataclass(frozen=True)
class _Solved:
    """One tick: CPU time [s], iterations, and the first inputs of its programs, in SI units."""

    seconds: float
    iterations: int
    first_inputs: Array


def _timings(ticks: Sequence[Tick]) -> Iterator[Timing]:
    expected = [solved.first_inputs for solved in _solved('exact', exact, ticks)]
    missing = []
    for name, make in SOLVERS.items():
        try:
            solved = list(_solved(name, make, ticks))
        except ImportError:
            missing.append(name)
            continue
        yield _timing(name, solved, expected, ticks[0])
    if missing:
        sys.stderr.write(
            f'not installed: {", ".join(missing)}; make setup EXTRA=bench installs them\n'
        )


def _timing(
    name: str, solved: Sequence[_Solved], expected: Sequence[Array], first: Tick
) -> Timing:
    unit = np.array([_first_inputs(problem, problem.units[0]) for problem in first])
    pairs = zip(solved, expected, strict=True)
    error = max(float(np.max(np.abs(one.first_inputs - right) / unit)) for one, right in pairs)
    times = np.array([1e3 * one.seconds for one in solved[1:]])
    return Timing(name, times, max(one.iterations for one in solved), SPEED_UNIT * error)


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
