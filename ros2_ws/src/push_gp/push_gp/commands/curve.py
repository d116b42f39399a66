"""`push_gp curve`: how the error falls with the number of training pushes."""

import argparse
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from push_core.common import InputError, Parser, check_place, json_text, run_command
from push_core.data import PushSet, read_pushes
from tqdm import tqdm

from push_gp.evaluation import METHODS, Place, learning_curve, sizes_within


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command; returns its exit status."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    arguments = Parser(
        'Trains on ever more of the pushes and scores each model on pushes that it has not seen.',
        epilog='Beside each other: a GP with zero mean, one over the fitted motion cone, and the '
        'cone\nalone: median and worst of the mean NMSE in the push frame, and what share the '
        '95 % interval\nholds. A fifth of the pushes, another one for each seed, is never trained '
        'on.\nExample: curve pushes.csv --seeds 5 --points 10 100 1000 --html curve.html',
    )
    arguments.prog = 'push_gp curve'
    arguments.add_argument('data', type=Path, help='CSV file of pushes')
    arguments.add_argument('--seeds', type=int, default=5, help='draws of each size (default 5)')
    arguments.add_argument(
        '--points',
        type=int,
        nargs='+',
        metavar='N',
        help='numbers of training pushes; default: 5 10 20 50 100 … as far as the data go',
    )
    arguments.add_argument('--json', action='store_true', help='one JSON object and nothing else')
    arguments.add_argument('--html', metavar='FILE', type=Path, help='write the curve as a page')
    return arguments


def work(arguments: argparse.Namespace) -> None:
    """Learns and says what came out.

    Raises:
        InputError: the file, the numbers of pushes or of seeds are wrong.
    """
    if arguments.seeds < 1:
        raise InputError(f'--seeds is {arguments.seeds}, must be at least 1')
    if arguments.html:
        check_place(arguments.html)
    pushes = read_pushes(arguments.data)
    places = _places(pushes, sizes_within(len(pushes), arguments.points), arguments.seeds)
    lines = list(_table(places))
    if arguments.html:
        # drawing takes a second to import: only who wants pictures waits for it
        from push_gp.evaluation.curve_page import write_curve_page  # noqa: PLC0415

        write_curve_page(arguments.html, places, lines)
    block = {'pushes': len(pushes), 'points': [place.as_json() for place in places]}
    sys.stdout.write(json_text(block) if arguments.json else '\n'.join([*lines, '']))


def _places(pushes: PushSet, sizes: Sequence[int], seeds: int) -> list[Place]:
    total = len(sizes) * len(METHODS) * seeds
    with tqdm(total=total, desc='learning', unit=' models', disable=None) as bar:
        return list(learning_curve(pushes, sizes, seeds, bar.update))


def _table(places: Sequence[Place]) -> Iterator[str]:
    yield 'mean NMSE in the push frame on unseen pushes, median (worst) of the seeds'
    yield f'{"N":>6}' + ''.join(f'{method:>20}' for method in METHODS)
    for row in range(0, len(places), len(METHODS)):
        several = places[row : row + len(METHODS)]
        yield f'{several[0].points:6d}' + ''.join(f'{_cell(place):>20}' for place in several)


def _cell(place: Place) -> str:
    figures = sorted(place.nmse.tolist())
    middle = 0.5 * (figures[(len(figures) - 1) // 2] + figures[len(figures) // 2])
    return f'{middle:.4f} ({figures[-1]:.4f})'


if __name__ == '__main__':
    sys.exit(main())
