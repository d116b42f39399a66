"""`push_gp evaluate`: how well a model tells a file of measured pushes."""

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from push_core.common import Parser, check_place, json_text, run_command
from push_core.data import OUTPUTS, READABLE, holds_long_pushes, read_long_pushes, read_pushes
from push_core.geometry import Array

from push_gp.evaluation import Evaluation, RolloutEvaluation, evaluate, rollout_evaluation
from push_gp.models import PushModel, model_named


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    arguments = Parser(
        'Compares a model with a file of measured pushes.',
        epilog='Prints RMSE, NMSE in the push frame and the body frame, NLPD, and what share the '
        '95 %\ninterval holds. Short pushes are those that `train` takes; for long ones (columns '
        'x0_m,\ny0_m, theta0_rad, …) the model is rolled out step by step and compared with where '
        'they\nended.',
    )
    arguments.prog = 'push_gp evaluate'
    arguments.add_argument('model', help="a model file, or 'analytical' for the motion cone")
    arguments.add_argument('data', type=Path, help='CSV file of pushes to compare with')
    arguments.add_argument('--json', action='store_true', help='one JSON object and nothing else')
    arguments.add_argument('--html', metavar='FILE', type=Path, help='write a page of pictures')
    return arguments


def work(arguments: argparse.Namespace) -> None:
    """Evaluates and says what came out."""
    if arguments.html:
        check_place(arguments.html)
    model = model_named(arguments.model)
    told = (_told_long if holds_long_pushes(arguments.data) else _told)(model, arguments)
    sys.stdout.write(told)


def _told(model: PushModel, arguments: argparse.Namespace) -> str:
    pushes = read_pushes(arguments.data)
    found = evaluate(model, pushes)
    if arguments.html:
        # drawing takes a second to import: only who wants pictures waits for it
        from push_gp.evaluation.evaluation_page import write_evaluation_page  # noqa: PLC0415

        write_evaluation_page(arguments.html, model, pushes, list(_table(found)))
    return json_text(found.as_json()) if arguments.json else '\n'.join([*_table(found), ''])


def _told_long(model: PushModel, arguments: argparse.Namespace) -> str:
    found = rollout_evaluation(model, read_long_pushes(arguments.data))
    if arguments.html:
        from push_gp.evaluation.rollout_page import write_rollout_page  # noqa: PLC0415

        write_rollout_page(arguments.html, found, list(_rollout_table(found)))
    if arguments.json:
        return json_text(found.as_json())
    return '\n'.join([*_rollout_table(found), ''])


def _rollout_table(found: RolloutEvaluation) -> Iterator[str]:
    figures = found.as_json()
    yield f'model {found.model_id} rolled out along {figures["n"]} pushes; mean error at the end'
    for name, block in figures['rollout'].items():
        error = f'{block["mean_mm"]:6.2f} mm {block["mean_deg"]:6.2f} deg' if block['n'] else ''
        yield f'{name.replace("_", " "):10}{block["n"]:5d} pushes {error}'


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
