"""`ros2 run push_bringup bench table`: the paper's experiments beside the paper's numbers."""

import argparse
import json
import sys
from collections.abc import Iterable, Sequence

from push_core.command_line import Parser, run_command
from push_core.errors import InputError
from push_gp.analytical_model import ANALYTICAL
from push_sim.settings import PROFILES
from tqdm import tqdm

from push_bringup.default_model import default_model
from push_bringup.paper_table import EXPERIMENTS, Row, laps

EPILOG = """The laps are run in process, with the plant's sensor noise drawn from seeds 0, 1, 2, …
Exit status: 0 every lap was completed, 1 one was not, 2 the command was wrong.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs a benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Runs the experiments of the paper.', EPILOG)
    described.add_argument('what', choices=('table',), help='table: its rows, both controllers')
    described.add_argument('--seeds', type=int, default=5, help='laps of each row (default 5)')
    described.add_argument('--profile', choices=tuple(PROFILES), default='irb120')
    described.add_argument(
        '--model', metavar='FILE', help='of the gp controller; default: 200 simulated pushes'
    )
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    return described


def work(arguments: argparse.Namespace) -> int:
    """Runs all rows and prints them.

    Raises:
        InputError: the model cannot be read, or the number of seeds is wrong.
    """
    if arguments.seeds < 1:
        raise InputError(f'--seeds is {arguments.seeds}, must be at least 1')
    models = {'gp': arguments.model or str(default_model()), 'analytical': ANALYTICAL}
    rows = list(_rows(models, arguments.profile, arguments.seeds))
    if arguments.json:
        sys.stdout.write(json.dumps({'rows': [row.as_json() for row in rows]}, indent=2) + '\n')
    else:
        sys.stdout.write(table(rows))
    return 0 if all(lap.completed for row in rows for lap in row.laps) else 1


def _rows(models: dict[str, str], profile: str, seeds: int) -> Iterable[Row]:
    total = len(EXPERIMENTS) * len(models) * seeds
    with tqdm(total=total, desc='pushing', unit=' laps', disable=None) as bar:
        for experiment in EXPERIMENTS:
            for controller, model in models.items():
                done = []
                for lap in laps(experiment, controller, model, profile, seeds):
                    done.append(lap)
                    bar.update()
                yield Row(experiment, controller, profile, tuple(done))


def table(rows: Iterable[Row]) -> str:
    """The rows as a Markdown table."""
    head = '| track | speed | perturbation | controller | laps | median | spread | paper |\n'
    return head + '|---|---|---|---|---|---|---|---|\n' + ''.join(map(_line, rows))


def _line(row: Row) -> str:
    figures = row.as_json()
    return (
        f'| {figures["track"]} | {1e3 * row.experiment.speed:.0f} mm/s '
        f'| {figures["perturbation"]} | {figures["controller"]} '
        f'| {figures["completed"]} of {figures["seeds"]} | {figures["median_mm"]:.2f} mm '
        f'| {figures["spread_mm"]:.2f} mm | {figures["paper_mm"]:.2f} mm |\n'
    )


if __name__ == '__main__':
    sys.exit(main())
