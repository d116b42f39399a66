"""`push_gp train`: a model file from a file of pushes."""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from push_core.common import InputError, Parser, check_place, run_command
from push_core.data import FORCE_HELP, OUTPUTS, PushSet, read_checked_pushes
from tqdm import tqdm

from push_gp.evaluation import training_summary
from push_gp.models import (
    MEAN_FUNCTIONS,
    GpModel,
    Rows,
    five_push_rows,
    nested_rows,
    random_rows,
    save_model,
    subset_rows,
)
from push_gp.training.train import train

MOST = 5000  # pushes that are all used; the fit takes half a minute
THINNED = 2000  # of more; the error of measured pushes hardly falls beyond, the fit takes seconds
LARGEST = 10_000  # the fit needs 5 GiB


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    arguments = Parser(
        'Trains a model on a file of pushes.',
        epilog='Example: train pushes.csv --points 200 --seed 0 -o model.npz',
    )
    arguments.prog = 'push_gp train'
    arguments.add_argument('data', type=Path, help='CSV file of pushes')
    arguments.add_argument('-o', '--output', type=Path, required=True, help='the model file')
    which = arguments.add_mutually_exclusive_group()
    which.add_argument(
        '--points',
        type=int,
        help=f'how many random pushes; default: all, {THINNED} of more than {MOST}',
    )
    which.add_argument('--subset', metavar='COLUMN', help='the pushes where COLUMN is 1')
    which.add_argument(
        '--pick',
        choices=['die'],
        help='the five pushes nearest to the pattern of the five of a die: at the middle of the '
        'face along its normal, and half-way to its ends 30 degrees to either side',
    )
    arguments.add_argument('--seed', type=int, help='of the random choice (default 0)')
    arguments.add_argument(
        '--nested',
        action='store_true',
        help='with the same seed, fewer --points are part of more',
    )
    arguments.add_argument(
        '--mean',
        choices=MEAN_FUNCTIONS,
        default='zero',
        help='prior mean: no motion, or a fitted motion cone (default zero)',
    )
    arguments.add_argument('--force', action='store_true', help=FORCE_HELP)
    return arguments


def work(arguments: argparse.Namespace) -> None:
    """Trains, saves and prints a summary.

    Raises:
        InputError: the file or the choice of pushes is wrong, or the model cannot be written.
    """
    check_place(arguments.output)
    pushes = read_checked_pushes(arguments.data, force=arguments.force)
    rows = chosen_rows(pushes, arguments)
    model = _trained(pushes.take(rows), arguments.mean)
    save_model(arguments.output, model)
    rest = np.setdiff1d(np.arange(len(pushes)), rows)
    summary = training_summary(model, pushes.take(rest) if rest.size > 1 else None)
    sys.stdout.write(f'{summary}\nmodel {model.info.model_id} written to {arguments.output}\n')


def chosen_rows(pushes: PushSet, arguments: argparse.Namespace) -> Rows:
    """Row numbers of the pushes to train on.

    Raises:
        InputError: the file does not have them.
    """
    random = arguments.subset is None and not arguments.pick
    if not random and (arguments.seed is not None or arguments.nested):
        raise InputError('--seed and --nested need a random choice: leave out --subset and --pick')
    if arguments.subset is not None:
        return subset_rows(pushes, arguments.subset)
    if arguments.pick:
        return five_push_rows(pushes)
    seed = arguments.seed or 0
    if seed < 0:
        raise InputError(f'--seed is {seed}, must not be negative')
    points = _all_or_thinned(pushes) if arguments.points is None else arguments.points
    if points > LARGEST:
        raise InputError(
            f'--points is {points}; an exact Gaussian process takes {LARGEST} at most'
        )
    choose = nested_rows if arguments.nested else random_rows
    return choose(pushes, points, seed)


def _all_or_thinned(pushes: PushSet) -> int:
    if len(pushes) <= MOST:
        return len(pushes)
    sys.stderr.write(
        f'{len(pushes)} pushes are many for an exact Gaussian process: {THINNED} random ones are '
        'used; --points chooses another number\n'
    )
    return THINNED


def _trained(pushes: PushSet, mean: str) -> GpModel:
    started = time.monotonic()
    with tqdm(desc=f'fitting {len(pushes)} pushes', total=len(OUTPUTS), disable=None) as bar:
        model = train(pushes, mean, lambda _output: bar.update())
    seconds = time.monotonic() - started
    sys.stdout.write(
        f'{len(pushes)} pushes of {pushes.distance * 1e3:g} mm, {mean} mean, '
        f'fitted in {seconds:.1f} s\n'
    )
    return model


if __name__ == '__main__':
    sys.exit(main())
