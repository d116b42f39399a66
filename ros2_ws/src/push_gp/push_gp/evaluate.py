"""`push_gp evaluate`: how well a model tells a file of measured pushes."""

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from push_core.accuracy import OUTPUTS, READABLE
from push_core.command_line import Parser, run_command
from push_core.frames import Array
from push_core.push_csv import read_pushes

from push_gp.evaluation import Evaluation, evaluation
from push_gp.model_source import model_named


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    arguments = Parser('Compares a model with a file of measured pushes.')
    arguments.prog = 'push_gp evaluate'
    arguments.add_argument('model', help="a model file, or 'analytical' for the motion cone")
    arguments.add_argument('data', type=Path, help='CSV file of pushes to compare with')
    arguments.add_argument('--json', action='store_true', help='one JSON object and nothing else')
    return arguments


def work(arguments: argparse.Namespace) -> None:
    """Evaluates and says what came out."""
    model = model_named(arguments.model)
    found = evaluation(model, read_pushes(arguments.data))
    text = json.dumps(found.as_json(), indent=2) if arguments.json else '\n'.join(_table(found))
    sys.stdout.write(f'{text}\n')


def _table(found: Evaluation) -> Iterator[str]:
    told = found.accuracy
    yield f'model {found.model_id} on {told.n} pushes'
    yield f'{"":18}' + ''.join(f'{name:>10}' for name in OUTPUTS) + f'{"mean":>10}'
    yield _row('rmse [mm mm deg]', told.rmse / READABLE)
    yield _row('NMSE, push frame', told.nmse_push_frame, with_mean=True)
    yield _row('NMSE, body frame', told.nmse_body_frame, with_mean=True)
    if found.calibration:
        yield _row('NLPD [nat]', found.calibration.nlpd)
        yield _row('in 95 % interval', found.calibration.coverage_95)
    if found.trained_on:
        yield (
            f'note: {found.trained_on} of these pushes are in the training set; '
            'the figures are too good by that'
        )


def _row(title: str, values: Array, *, with_mean: bool = False) -> str:
    shown = [*values, values.mean()] if with_mean else [*values]
    return f'{title:18}' + ''.join(f'{value:10.4f}' for value in np.array(shown))


if __name__ == '__main__':
    sys.exit(main())
