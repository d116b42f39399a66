"""`bench data`: error of the GP controller over the number of training pushes.

As in the paper: nested random draws from a large set of pushes, and the five pushes of a die.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from push_core.common import InputError, Parser, run_command, worker_pool, write_atomically
from push_core.data import PushSet, read_checked_pushes
from push_gp.models import ANALYTICAL, MEAN_FUNCTIONS, five_push_rows, nested_rows, save_model
from push_gp.training.train import train
from push_sim.collect import collect_pushes
from push_sim.settings import PROFILES
from tqdm import tqdm

from push_bringup.bench.options import (
    add_lap_options,
    check_positive,
    opened_store,
    print_results,
)
from push_bringup.bench.rows import SizeRow
from push_bringup.experiment import Experiment, Lap, LapJob, push_all
from push_bringup.setup import MODEL_SOURCES, code_key

SIZES = (5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000)
TRACK = Experiment('eight', 0.08)
COLLECTED = 10_000
EPILOG = """Example: bench data --points 10 50 200 --draws 10 --html data.html
Draw k is random with seed k; it is part of every larger draw of that seed.
Exit status: 0 done, also where laps were not completed, 2 the command was wrong.
"""


@dataclass(frozen=True)
class TrainingSet:
    """A training set: number of pushes, mean function, how they are chosen, number of the draw."""

    points: int
    mean: str
    choice: str
    draw: int


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the benchmark."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser(
        'Pushes the 8-track at 80 mm/s with GPs of more and more training pushes.', EPILOG
    )
    described.prog = 'bench data'
    described.add_argument(
        '--points', type=int, nargs='+', default=list(SIZES), metavar='N', help='numbers of pushes'
    )
    described.add_argument('--draws', type=int, default=10, help='of each size (default 10)')
    described.add_argument(
        '--mean', choices=MEAN_FUNCTIONS, nargs='+', default=list(MEAN_FUNCTIONS)
    )
    described.add_argument('--profile', choices=tuple(PROFILES), default='irb120')
    described.add_argument(
        '--data', type=Path, metavar='FILE', help=f'pushes; default: {COLLECTED} simulated ones'
    )
    described.add_argument(
        '--models', type=Path, default=Path('runs/bench_models'), help='folder of the models'
    )
    add_lap_options(described, Path('runs/bench_data.jsonl'))
    return described


def work(arguments: argparse.Namespace) -> None:
    """Trains, pushes and prints.

    Raises:
        InputError: the pushes cannot be read, or a number is out of range.
    """
    check_positive('--draws', arguments.draws)
    store = opened_store(arguments)
    pushes = _pushes(arguments)
    sets = list(_training_sets(arguments, len(pushes)))
    models = _trained(pushes, sets, arguments)
    jobs = [LapJob(TRACK, 'gp', str(model), arguments.profile, 0) for model in models]
    jobs.append(LapJob(TRACK, 'analytical', ANALYTICAL, arguments.profile, 0))
    *laps, analytical = push_all(jobs, store, arguments.jobs)
    rows = _rows(sets, laps)
    if arguments.html is not None:
        # plotly takes a second to import: only a page needs it
        from push_bringup.bench.training_size_page import training_size_page  # noqa: PLC0415

        write_atomically(arguments.html, training_size_page(rows, analytical).encode())
    results = {
        'points': [row.as_json() for row in rows],
        'analytical': {
            'completed': analytical.completed,
            'stop_reason': analytical.stop_reason,
            'mean_mm': analytical.mean_mm,
        },
    }
    print_results(arguments, 'data', results)


def _pushes(arguments: argparse.Namespace) -> PushSet:
    if arguments.data is not None:
        return read_checked_pushes(arguments.data)
    return collect_pushes(COLLECTED, 0, arguments.profile, jobs=arguments.jobs)


def _training_sets(arguments: argparse.Namespace, available: int) -> Iterator[TrainingSet]:
    for points in arguments.points:
        if not 1 <= points <= available:
            raise InputError(f'--points {points}: there are {available} pushes')
    for mean in arguments.mean:
        yield TrainingSet(5, mean, 'die', 0)
        for points in arguments.points:
            for draw in range(arguments.draws):
                yield TrainingSet(points, mean, 'random', draw)


def _trained(
    pushes: PushSet, sets: Sequence[TrainingSet], arguments: argparse.Namespace
) -> list[Path]:
    """The model file of each training set; the same code trains each once."""
    folder = arguments.models / f'{pushes.sha256()[:12]}_{code_key(MODEL_SOURCES)[:12]}'
    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / f'{s.choice}_{s.points}_{s.mean}_{s.draw}.npz' for s in sets]
    work = [
        (file, pushes.take(chosen_rows(pushes, each)), each.mean)
        for file, each in zip(files, sets, strict=True)
        if not file.is_file()
    ]
    if work:
        with worker_pool(arguments.jobs) as pool:
            done = pool.as_done(_train, work)
            list(tqdm(done, 'training', len(work), unit=' models', disable=None))
    return files


def _train(file: Path, pushes: PushSet, mean: str) -> None:
    save_model(file, train(pushes, mean))


def chosen_rows(pushes: PushSet, training_set: TrainingSet) -> np.ndarray:
    """Row numbers of the pushes in a training set."""
    if training_set.choice == 'die':
        return five_push_rows(pushes)
    return nested_rows(pushes, training_set.points, training_set.draw)


def _rows(sets: Sequence[TrainingSet], laps: Sequence[Lap]) -> list[SizeRow]:
    groups: dict[tuple[int, str, str], list[Lap]] = {}
    for each, lap in zip(sets, laps, strict=True):
        groups.setdefault((each.points, each.mean, each.choice), []).append(lap)
    return [SizeRow(*size, tuple(group)) for size, group in groups.items()]


if __name__ == '__main__':
    sys.exit(main())
