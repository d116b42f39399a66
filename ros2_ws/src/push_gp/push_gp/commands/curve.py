"""`push_gp curve`: error on held-out pushes against the number of training pushes."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import (
    InputError,
    Parser,
    check_place,
    json_text,
    plain_table,
    run_command,
)
from push_core.data import FORCE_HELP, PushSet, read_checked_pushes
from tqdm import tqdm

from push_gp.evaluation import METHODS, CurvePoint, curve_sizes, learning_curve


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    arguments = Parser(
        'Trains models on more and more of the pushes and scores them on held-out pushes.',
        epilog='Compares a GP with zero mean, a GP over the fitted motion cone, and that cone '
        'alone by\nthe median and the worst mean NMSE in the push frame; --json has the coverage '
        'of the 95 %\ninterval too. In each seed another fifth of the pushes is held out.'
        '\nExample: curve pushes.csv --seeds 5 --points 10 100 1000 --html curve.html',
    )
    arguments.prog = 'push_gp curve'
    arguments.add_argument('data', type=Path, help='CSV file of pushes')
    arguments.add_argument(
        '--seeds', type=int, default=5, help='random draws of each size (default 5)'
    )
    arguments.add_argument(
        '--points',
        type=int,
        nargs='+',
        metavar='N',
        help='numbers of training pushes; default: 5 10 20 50 100 … as many as the file allows',
    )
    arguments.add_argument('--force', action='store_true', help=FORCE_HELP)
    arguments.add_argument('--json', action='store_true', help='print one JSON object only')
    arguments.add_argument('--html', metavar='FILE', type=Path, help='also write an HTML page')
    return arguments


def work(arguments: argparse.Namespace) -> None:
    """Trains all models and prints the curve.

    Raises:
        InputError: the file, the numbers of pushes or of seeds are wrong.
    """
    if arguments.seeds < 1:
        raise InputError(f'--seeds is {arguments.seeds}, must be at least 1')
    if arguments.html:
        check_place(arguments.html)
    pushes = read_checked_pushes(arguments.data, force=arguments.force)
    points = _points(pushes, curve_sizes(len(pushes), arguments.points), arguments.seeds)
    lines = _lines(points)
    if arguments.html:
        # plotly takes a second to import
        from push_gp.evaluation.curve_page import write_curve_page  # noqa: PLC0415

        write_curve_page(arguments.html, points, lines)
    block = {'pushes': len(pushes), 'points': [point.as_json() for point in points]}
    sys.stdout.write(json_text(block) if arguments.json else '\n'.join([*lines, '']))


def _points(pushes: PushSet, sizes: Sequence[int], seeds: int) -> list[CurvePoint]:
    total = len(sizes) * len(METHODS) * seeds
    with tqdm(total=total, desc='training', unit=' models', disable=None) as bar:
        return list(learning_curve(pushes, sizes, seeds, bar.update))


def _lines(points: Sequence[CurvePoint]) -> list[str]:
    rows = [
        (str(several[0].points), *map(_cell, several))
        for several in zip(*[iter(points)] * len(METHODS), strict=True)
    ]
    title = 'mean NMSE in the push frame on held-out pushes, median (worst) of the seeds'
    return [title, *plain_table([('N', *METHODS), *rows], left=0)]


def _cell(point: CurvePoint) -> str:
    figures = sorted(point.nmse.tolist())
    middle = 0.5 * (figures[(len(figures) - 1) // 2] + figures[len(figures) // 2])
    return f'{middle:.4f} ({figures[-1]:.4f})'


if __name__ == '__main__':
    sys.exit(main())
