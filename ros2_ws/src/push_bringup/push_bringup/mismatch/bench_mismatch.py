"""`bench mismatch`: laps on plants that differ from what the controller assumes."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import Parser, finite, run_command

from push_bringup.bench import (
    MismatchRow,
    add_controllers,
    add_lap_options,
    check_positive,
    mismatch_rows,
    opened_store,
    print_results,
)
from push_bringup.experiment import LapJob, push_all
from push_bringup.mismatch.plants import PLANTS
from push_bringup.setup import model_for

EPILOG = """Examples: bench mismatch --rows home rim friction_0.6 --seeds 2
          bench mismatch --rows rim varies_0.2 --seeds 1 --laps 6 --learn
Errors are those of the true poses, medians of the completed runs: of several laps the first → the
second → the last. Profile irb120 unless the row says another, the default model of the gp
controller, and one set of parameters for all plants. In process: 12 minutes of processor time with
5 seeds.
Exit status: 0 every lap was completed, 1 one was not, 2 the command was wrong.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser(
        'Pushes laps on plants that differ from what the controller assumes.', EPILOG
    )
    described.prog = 'bench mismatch'
    described.add_argument('--seeds', type=int, default=5, help='laps of each row (default 5)')
    described.add_argument(
        '--rows',
        choices=tuple(PLANTS),
        nargs='+',
        default=list(PLANTS),
        metavar='ROW',
        help=f'only these of {", ".join(PLANTS)}',
    )
    described.add_argument('--laps', type=int, default=1, help='rounds of each run (default 1)')
    described.add_argument('--learn', action='store_true', help='let each lap teach the next')
    add_controllers(described)
    add_lap_options(described, Path('runs/bench_mismatch.jsonl'))
    return described


def work(arguments: argparse.Namespace) -> int:
    """Pushes all rows and prints them.

    Raises:
        InputError: a number is out of range, or a file cannot be used.
    """
    check_positive('--seeds', arguments.seeds)
    check_positive('--laps', arguments.laps)
    store = opened_store(arguments)
    cases = [(name, each) for name in arguments.rows for each in arguments.controllers]
    laps = iter(push_all(_jobs(cases, arguments), store, arguments.jobs))
    rows = [
        MismatchRow(
            name,
            PLANTS[name].text,
            PLANTS[name].experiment,
            controller,
            tuple(next(laps) for _ in range(arguments.seeds)),
            arguments.learn,
        )
        for name, controller in cases
    ]
    results = {'rows': [row.as_json() for row in rows]}
    if arguments.html is not None:
        # plotly takes a second to import: only a page needs it
        from push_report.page import write_page  # noqa: PLC0415

        lines = mismatch_rows(finite(results)).splitlines()
        write_page(arguments.html, 'Plants that the controller does not know', lines, ())
    print_results(arguments, 'mismatch', results)
    return 0 if all(row.completed == len(row.laps) for row in rows) else 1


def _jobs(cases: Sequence[tuple[str, str]], arguments: argparse.Namespace) -> list[LapJob]:
    """All runs: by plant, then by controller, then by seed."""
    models = {controller: model_for(controller) for _, controller in cases}
    return [
        LapJob(
            PLANTS[name].experiment,
            controller,
            models[controller],
            PLANTS[name].profile,
            seed,
            PLANTS[name].overrides,
            arguments.laps,
            arguments.learn,
        )
        for name, controller in cases
        for seed in range(arguments.seeds)
    ]


if __name__ == '__main__':
    sys.exit(main())
