"""`bench table`: the paper's experiments, compared with the paper's figures."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import Parser, run_command, write_atomically
from push_gp.models import load_model
from push_sim.settings import PROFILES

from push_bringup.bench.options import (
    add_controllers,
    add_lap_options,
    add_model,
    check_positive,
    opened_store,
    print_results,
)
from push_bringup.bench.rows import PaperRow
from push_bringup.experiment import PAPER_MM, LapJob, push_all
from push_bringup.setup import model_for

EPILOG = """Example: bench table --profile irb120 ideal --seeds 5 --html table.html
The laps are pushed in process; everything random is drawn from seeds 0, 1, 2, …
Exit status: 0 every lap was completed, 1 one was not, 2 the command was wrong.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser("Pushes the experiments of the paper's table with all controllers.", EPILOG)
    described.prog = 'bench table'
    described.add_argument('--seeds', type=int, default=5, help='laps of each row (default 5)')
    described.add_argument(
        '--profile', choices=tuple(PROFILES), nargs='+', default=['irb120'], help='of the plant'
    )
    add_model(described)
    add_controllers(described)
    add_lap_options(described, Path('runs/bench_table.jsonl'))
    return described


def work(arguments: argparse.Namespace) -> int:
    """Pushes all rows and prints them.

    Raises:
        InputError: the model cannot be read, or a number is out of range.
    """
    check_positive('--seeds', arguments.seeds)
    store = opened_store(arguments)
    if arguments.model is not None:
        load_model(Path(arguments.model))
    models = {name: model_for(name, arguments.model) for name in arguments.controllers}
    cases = [
        (experiment, controller, profile)
        for profile in arguments.profile
        for experiment in PAPER_MM
        for controller in arguments.controllers
    ]
    jobs = [
        LapJob(experiment, controller, models[controller], profile, seed)
        for experiment, controller, profile in cases
        for seed in range(arguments.seeds)
    ]
    laps = iter(push_all(jobs, store, arguments.jobs))
    rows = [PaperRow(*case, tuple(next(laps) for _ in range(arguments.seeds))) for case in cases]
    if arguments.html is not None:
        # plotly takes a second to import: only a page needs it
        from push_bringup.bench.paper_page import paper_page  # noqa: PLC0415

        write_atomically(arguments.html, paper_page(rows).encode())
    print_results(arguments, 'table', {'rows': [row.as_json() for row in rows]})
    return 0 if all(row.completed == len(row.laps) for row in rows) else 1


if __name__ == '__main__':
    sys.exit(main())
