"""`bench realtime`: the paper's experiments in real time, compared with the same in process."""

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from push_core.common import Parser, RunError, run_command
from tqdm import tqdm

from push_bringup.bench.options import add_controllers, check_positive, print_results
from push_bringup.bench.rows import RealTimeRow, times_json
from push_bringup.experiment import PAPER_MM, Experiment, LapJob, LapStore, push_all
from push_bringup.setup import code_key, model_for

LAPS_FILE = 'in_process.jsonl'
EPILOG = """Example: bench realtime --runs 3 --controllers gp
Each run is a run of `cell` and takes as long as its lap: 4 minutes for the five rows. Nothing
else should run meanwhile. Runs of the same code that are in the folder are not repeated, so that
an interrupted benchmark goes on.
Exit status: 0 every lap was completed, 1 one was not, 2 the command was wrong.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser("Pushes the paper's experiments in real time and in process.", EPILOG)
    described.prog = 'bench realtime'
    described.add_argument('--runs', type=int, default=3, help='of each row (default 3)')
    add_controllers(described)
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    described.add_argument(
        '-o',
        '--output',
        type=Path,
        default=Path('runs/bench_realtime'),
        help='folder of the runs (default %(default)s)',
    )
    return described


def work(arguments: argparse.Namespace) -> int:
    """Pushes every experiment in both ways and prints the rows.

    Raises:
        InputError: a number is out of range, or the folder cannot be used.
        RunError: a run left no score.
    """
    check_positive('--runs', arguments.runs)
    store = LapStore(arguments.output / LAPS_FILE)
    cases = [
        (experiment, controller) for controller in arguments.controllers for experiment in PAPER_MM
    ]
    errors = iter(_in_process(cases, arguments.runs, store))
    scores = iter(list(_real_time(cases, arguments.runs, arguments.output)))
    runs = range(arguments.runs)
    rows = [
        RealTimeRow(*case, tuple(next(errors) for _ in runs), tuple(next(scores) for _ in runs))
        for case in cases
    ]
    results = {
        'rows': [row.as_json() for row in rows],
        'times': [times_json(controller, rows) for controller in arguments.controllers],
    }
    print_results(arguments, 'realtime', results)
    return 0 if all(row.completed == arguments.runs for row in rows) else 1


def _in_process(
    cases: Sequence[tuple[Experiment, str]], runs: int, store: LapStore
) -> list[float]:
    """Mean errors [mm] of all runs in process, one at a time."""
    jobs = [
        LapJob(experiment, controller, model_for(controller), 'irb120', seed)
        for experiment, controller in cases
        for seed in range(runs)
    ]
    return [lap.mean_mm for lap in push_all(jobs, store, processes=1)]


def _real_time(
    cases: Sequence[tuple[Experiment, str]], runs: int, folder: Path
) -> Iterator[dict[str, Any]]:
    """Scores of all runs in real time."""
    each = [(*case, seed) for case in cases for seed in range(runs)]
    for experiment, controller, seed in tqdm(each, 'real time', unit=' runs', disable=None):
        name = f'{experiment.track}_{1e3 * experiment.speed:.0f}_{experiment.perturbation}'
        run = f'{name}_{controller}_{seed}'
        yield _run(experiment, controller, seed, folder / code_key()[:12] / run)


def _run(experiment: Experiment, controller: str, seed: int, folder: Path) -> dict[str, Any]:
    """Score of a run of `cell` into a folder; one that is there already is not repeated."""
    if not list(folder.glob('*/score.json')):
        command = [
            *(sys.executable, '-m', 'push_bringup.commands.cell', '--mode', 'realtime'),
            *('--track', experiment.track, '--speed', str(experiment.speed)),
            *('--perturb', experiment.perturbation, '--controller', controller),
            *('--seed', str(seed), '-o', str(folder)),
        ]
        subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    scores = list(folder.glob('*/score.json'))
    if not scores:
        raise RunError(f'a run left no score in {folder}; see its output above')
    score: dict[str, Any] = json.loads(scores[0].read_text(encoding='utf-8'))
    return score


if __name__ == '__main__':
    sys.exit(main())
