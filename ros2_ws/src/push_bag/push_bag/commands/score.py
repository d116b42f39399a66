"""`push_bag score RUN…`: scores runs, as table, JSON or report, and checks bounds."""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from push_core.common import InputError, Parser, RunError, json_text, run_command, write_atomically
from tqdm import tqdm

from push_bag.run import RunSeries, read_starts
from push_bag.score import (
    Scores,
    bag_score,
    bound,
    check_bounds,
    comparison_table,
    runs_object,
    runs_table,
    score_series,
    score_table,
)

T = TypeVar('T')
ScoredStart: TypeAlias = tuple[RunSeries, dict[str, Any]]

EPILOG = """
examples:
  ros2 run push_bag score runs/RUN
  ros2 run push_bag score runs/A runs/B --html report.html
  ros2 run push_bag score runs/*                      one line per run, mean and spread
  ros2 run push_bag score runs/A runs/B --compare     one line per figure, with the difference
  ros2 run push_bag score runs/RUN --fail-above incomplete=0 --fail-above mean=3.0
  ros2 run push_bag score runs/RUN --fail-above solve_ms.p99=2 --fail-above lost=0

Each start of a controller in a bag is scored by itself; all are listed, --start chooses one.
A figure is named by its path in the JSON; mean, rms, p95 and max alone mean those of the tracking
error. `lost` is the number of lost messages; `incomplete` is 1 for a run that was not completed,
else 0. Definitions: docs/scoring.md.
Where a run lacks a figure, the table and `reasons` in the JSON say why.
Exit status: 0 scored, 1 no tracking error or a figure exceeds its bound, 2 wrong command line or
bag.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Scores runs."""
    return run_command(_parser(), _work, argv)


def _parser() -> Parser:
    parser = Parser('Scores recorded runs.', EPILOG)
    parser.add_argument(
        'runs', type=Path, nargs='+', metavar='RUN', help='run folder or MCAP file'
    )
    parser.add_argument('--json', action='store_true', help='print a JSON object')
    parser.add_argument(
        '--html',
        type=Path,
        metavar='FILE',
        help='also write an HTML report; several runs share each figure',
    )
    parser.add_argument(
        '--compare', action='store_true', help='print two runs or starts, one line per figure'
    )
    parser.add_argument(
        '--start', type=int, metavar='N', help='score only the N-th start of each bag, from 1'
    )
    parser.add_argument(
        '--fail-above',
        action='append',
        default=[],
        metavar='FIGURE=VALUE',
        help='end with status 1 if a figure of a run exceeds VALUE; repeatable',
    )
    return parser


def _work(arguments: argparse.Namespace) -> None:
    bounds = [bound(text) for text in arguments.fail_above]
    if arguments.compare and arguments.json:
        raise InputError('--compare excludes --json')
    paths = tqdm(arguments.runs, unit='run', desc='scoring', disable=None, leave=False)
    bags = [(str(path), _of(path, lambda path: _scored(path, arguments.start))) for path in paths]
    scores = [(name, score) for run, scored in bags for name, _, score in _named(run, scored)]
    if arguments.compare and len(scores) != 2:
        raise InputError(f'--compare takes two runs or starts, not {len(scores)}')
    if arguments.html is not None:
        # plotly takes a second to import
        from push_bag.report.report import report_html  # noqa: PLC0415

        every = [each for _, scored in bags for each in scored]
        write_atomically(arguments.html, report_html(every).encode())
    sys.stdout.write(_text(arguments, bags, scores))
    _check_scored(scores)
    check_bounds(scores, bounds)


def _scored(path: Path, start: int | None) -> list[ScoredStart]:
    """The starts of a bag with their scores; only the one with a number, if it is given."""
    starts = read_starts(path)
    if start is None:
        return [(run, score_series(run)) for run in starts]
    if not 1 <= start <= len(starts):
        raise InputError(f'there is no start {start}: the bag holds {len(starts)}')
    return [(run := starts[start - 1], score_series(run))]


def _named(run: str, scored: Sequence[ScoredStart]) -> list[tuple[str, RunSeries, dict[str, Any]]]:
    """The starts of a bag with a name for each."""
    if len(scored) == 1:
        return [(run, *scored[0])]
    return [(f'{run} start {number}', *each) for number, each in enumerate(scored, start=1)]


def _check_scored(scores: Scores) -> None:
    """Checks that each score has a tracking error.

    Raises:
        RunError: one has none; says why.
    """
    for run, score in scores:
        reason = score['reasons'].get('tracking_error_mm')
        if reason:
            raise RunError(f'{run} has no tracking error: {reason}')


def _of(path: Path, work: Callable[[Path], T]) -> T:
    """The result of `work` for a bag; adds the path of the bag to its errors."""
    try:
        return work(path)
    except InputError as error:
        raise InputError(str(error) if str(path) in str(error) else f'{path}: {error}') from error


def _text(
    arguments: argparse.Namespace, bags: Sequence[tuple[str, list[ScoredStart]]], scores: Scores
) -> str:
    if arguments.compare:
        return comparison_table(scores)
    if arguments.json and len(bags) == 1:
        return json_text(bag_score([score for _, score in bags[0][1]]))
    if arguments.json:
        return json_text(runs_object(scores))
    return score_table(scores[0][1]) if len(scores) == 1 else runs_table(scores)


if __name__ == '__main__':
    sys.exit(main())
