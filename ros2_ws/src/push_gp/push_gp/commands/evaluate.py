"""`push_gp evaluate`: errors of a model on a file of measured pushes."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import Parser, check_place, json_text, plain_table, run_command
from push_core.data import (
    FORCE_HELP,
    OUTPUTS,
    READABLE,
    holds_long_pushes,
    read_checked_pushes,
    read_long_pushes,
)
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
        epilog='Prints RMSE, NMSE in the push frame and the body frame, NLPD, and the coverage of '
        'the\n95 % interval. Short pushes have the columns that `train` reads. Along long pushes '
        '(columns\nx0_m, y0_m, theta0_rad, …) the model is rolled out, and the end poses are '
        'compared.',
    )
    arguments.prog = 'push_gp evaluate'
    arguments.add_argument('model', help="a model file, or 'analytical' for the motion cone")
    arguments.add_argument('data', type=Path, help='CSV file of pushes to compare with')
    arguments.add_argument('--force', action='store_true', help=FORCE_HELP)
    arguments.add_argument('--json', action='store_true', help='print one JSON object only')
    arguments.add_argument('--html', metavar='FILE', type=Path, help='also write an HTML page')
    return arguments


def work(arguments: argparse.Namespace) -> None:
    """Evaluates and prints.

    Raises:
        InputError: a file is wrong, or the pushes are of another distance.
    """
    if arguments.html:
        check_place(arguments.html)
    model = model_named(arguments.model)
    evaluated = _long_pushes if holds_long_pushes(arguments.data) else _short_pushes
    sys.stdout.write(evaluated(model, arguments))


def _short_pushes(model: PushModel, arguments: argparse.Namespace) -> str:
    pushes = read_checked_pushes(arguments.data, force=arguments.force)
    result = evaluate(model, pushes)
    lines = _lines(result)
    if arguments.html:
        # plotly takes a second to import
        from push_gp.evaluation.evaluation_page import write_evaluation_page  # noqa: PLC0415

        write_evaluation_page(arguments.html, model, pushes, lines)
    return json_text(result.as_json()) if arguments.json else '\n'.join([*lines, ''])


def _long_pushes(model: PushModel, arguments: argparse.Namespace) -> str:
    result = rollout_evaluation(model, read_long_pushes(arguments.data))
    lines = _rollout_lines(result)
    if arguments.html:
        from push_gp.evaluation.rollout_page import write_rollout_page  # noqa: PLC0415

        write_rollout_page(arguments.html, result, lines)
    return json_text(result.as_json()) if arguments.json else '\n'.join([*lines, ''])


def _rollout_lines(result: RolloutEvaluation) -> list[str]:
    block = result.as_json()
    rows = [
        (
            *(name.replace('_', ' '), f'{errors["n"]} pushes'),
            *(f'{errors["mean_mm"]:.2f} mm', f'{errors["mean_deg"]:.2f} deg'),
        )
        if errors['n']
        else (name.replace('_', ' '), '0 pushes', '', '')
        for name, errors in block['rollout'].items()
    ]
    title = f'model {result.model_id} rolled out along {block["n"]} pushes; mean error at the end'
    return [title, *plain_table(rows)]


def _lines(result: Evaluation) -> list[str]:
    errors, uncertainty = result.accuracy, result.uncertainty
    rows = [
        ('', *OUTPUTS, 'mean'),
        _row('rmse [mm mm deg]', errors.rmse / READABLE),
        _row('NMSE, push frame', errors.nmse_push_frame, errors.nmse_push_frame.mean()),
        _row('NMSE, body frame', errors.nmse_body_frame, errors.nmse_body_frame.mean()),
    ]
    if uncertainty:
        rows.append(_row('NLPD [nat]', uncertainty.nlpd))
        rows.append(_row('in 95 % interval', uncertainty.coverage_95))
    lines = [f'model {result.model_id} on {errors.n} pushes', *plain_table(rows)]
    if result.trained_on:
        lines.append(
            f'note: {result.trained_on} of these pushes are in the training set; '
            'the errors are too small for that reason'
        )
    return lines


def _row(title: str, values: Array, mean: float | None = None) -> tuple[str, ...]:
    return (title, *(f'{value:.4f}' for value in values), '' if mean is None else f'{mean:.4f}')


if __name__ == '__main__':
    sys.exit(main())
