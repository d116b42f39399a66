"""`bench realtime`: the paper's experiments by the clock, beside the same ones in process."""

import argparse
import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from push_core.common import Parser, RunError, json_text, run_command
from push_gp.models import ANALYTICAL
from tqdm import tqdm

from push_bringup.bench.options import add_controllers, check_positive
from push_bringup.experiment import PAPER_MM, Experiment, LapJob, LapStore, push_all
from push_bringup.setup import code_key, default_model

LAPS_FILE = 'in_process.jsonl'
EPILOG = """Example: bench realtime --runs 3 --controllers gp
Each run is one of `cell`, about as long as its lap: 4 minutes for the five rows. Nothing else
should run meanwhile. Runs of the same code that are in the folder are not repeated, so that an
interrupted benchmark goes on.
Exit status: 0 every lap was completed, 1 one was not, 2 the command was wrong.
"""


@dataclass(frozen=True)
class Agreement:
    """One experiment with one controller, both ways.

    Attributes:
        experiment: what was pushed.
        controller: gp or analytical.
        in_process_mm: mean tracking error of each run in process, seeds 0, 1, ….
        real_time_mm: the same by the clock.
        completed: runs by the clock that came to their end.
        deadline_misses: commands that left late or never, of all runs by the clock.
    """

    experiment: Experiment
    controller: str
    in_process_mm: tuple[float, ...]
    real_time_mm: tuple[float, ...]
    completed: int
    deadline_misses: int

    @property
    def ratio(self) -> float:
        """Median error by the clock over that in process."""
        return median(self.real_time_mm) / median(self.in_process_mm)

    def as_json(self) -> dict[str, object]:
        """The row as `--json` prints it."""
        return {
            'track': self.experiment.track,
            'speed_m_s': self.experiment.speed,
            'perturbation': self.experiment.perturbation,
            'controller': self.controller,
            'runs': len(self.real_time_mm),
            'completed': self.completed,
            'in_process_mm': median(self.in_process_mm),
            'real_time_mm': median(self.real_time_mm),
            'ratio': self.ratio,
            'deadline_misses': self.deadline_misses,
        }


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser("Pushes the paper's rows in real time and in process.", EPILOG)
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
    """Pushes all rows both ways and prints them.

    Raises:
        InputError: a number is out of range, or the folder cannot be used.
        RunError: a run left no score.
    """
    check_positive('--runs', arguments.runs)
    store = LapStore(arguments.output / LAPS_FILE)
    cases = [
        (experiment, controller) for controller in arguments.controllers for experiment in PAPER_MM
    ]
    in_process = iter(_in_process(cases, arguments.runs, store))
    scores = iter(list(_real_time(cases, arguments.runs, arguments.output)))
    rows = [
        _agreement(*case, [(next(in_process), next(scores)) for _ in range(arguments.runs)])
        for case in cases
    ]
    if arguments.json:
        sys.stdout.write(json_text({'rows': [row.as_json() for row in rows]}))
    else:
        sys.stdout.write(table(rows))
    return 0 if all(row.completed == arguments.runs for row in rows) else 1


def table(rows: Sequence[Agreement]) -> str:
    """The rows as a Markdown table."""
    head = '| track | speed | perturbation | controller | laps | in process | real time | ratio |'
    lines = [f'{head} late commands |', '|---' * 9 + '|', *map(_line, rows)]
    return '\n'.join(lines) + '\n'


def _line(row: Agreement) -> str:
    told = row.as_json()
    return (
        f'| {told["track"]} | {1e3 * row.experiment.speed:.0f} mm/s | {told["perturbation"]} '
        f'| {told["controller"]} | {told["completed"]} of {told["runs"]} '
        f'| {told["in_process_mm"]:.2f} mm | {told["real_time_mm"]:.2f} mm '
        f'| {row.ratio:.2f} | {row.deadline_misses} |'
    )


def _agreement(
    experiment: Experiment, controller: str, pairs: Sequence[tuple[float, dict[str, object]]]
) -> Agreement:
    scores = [score for _, score in pairs]
    return Agreement(
        experiment,
        controller,
        tuple(error for error, _ in pairs),
        tuple(float(score['tracking_error_mm']['mean']) for score in scores),  # type: ignore[index]
        sum(bool(score['completed']) for score in scores),
        sum(int(score['deadline_misses']) for score in scores),  # type: ignore[call-overload]
    )


def _in_process(
    cases: Sequence[tuple[Experiment, str]], runs: int, store: LapStore
) -> list[float]:
    """Mean errors [mm] of all runs, one process at a time."""
    models = {'gp': str(default_model()), 'analytical': ANALYTICAL}
    jobs = [
        LapJob(experiment, controller, models[controller], 'irb120', seed)
        for experiment, controller in cases
        for seed in range(runs)
    ]
    return [lap.mean_mm for lap in push_all(jobs, store, processes=1)]


def _real_time(
    cases: Sequence[tuple[Experiment, str]], runs: int, folder: Path
) -> Iterator[dict[str, object]]:
    """Scores of all runs by the clock."""
    each = [(*case, seed) for case in cases for seed in range(runs)]
    for experiment, controller, seed in tqdm(each, 'real time', unit=' runs', disable=None):
        name = f'{experiment.track}_{1e3 * experiment.speed:.0f}_{experiment.perturbation}'
        run = f'{name}_{controller}_{seed}'
        yield _run(experiment, controller, seed, folder / code_key()[:12] / run)


def _run(experiment: Experiment, controller: str, seed: int, folder: Path) -> dict[str, object]:
    """Score of one run of `cell` into a folder, or of the one that is there."""
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
        raise RunError(f'a run left no score in {folder}; what it said stands above')
    score: dict[str, object] = json.loads(scores[0].read_text(encoding='utf-8'))
    return score


if __name__ == '__main__':
    sys.exit(main())
