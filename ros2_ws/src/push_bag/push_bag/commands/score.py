"""`push_bag score RUN…`: scores runs, as table, JSON or report, and checks bounds."""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, TypeVar

from push_core.common import InputError, Parser, RunError, json_text, run_command, write_atomically
from tqdm import tqdm

from push_bag.run import RunSeries, read_run
from push_bag.score import (
    Scores,
    bound,
    check_bounds,
    comparison_table,
    runs_object,
    runs_table,
    score_run,
    score_series,
    score_table,
)

T = TypeVar('T')

EPILOG = """
examples:
  ros2 run push_bag score runs/RUN
  ros2 run push_bag score runs/A runs/B --html report.html
  ros2 run push_bag score runs/*                      one line per run, mean and spread
  ros2 run push_bag score runs/A runs/B --compare     one line per figure, with the difference
  ros2 run push_bag score runs/RUN --fail-above incomplete=0 --fail-above mean=3.0
  ros2 run push_bag score runs/RUN --fail-above solve_ms.p99=2 --fail-above lost=0

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
        '--compare', action='store_true', help='print two runs, one line per figure'
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
    if arguments.compare and (len(arguments.runs) != 2 or arguments.json):
        raise InputError('--compare takes two runs and excludes --json')
    scores = list(zip(map(str, arguments.runs), _scored(arguments), strict=True))
    sys.stdout.write(_text(arguments, scores))
    _check_scored(scores)
    check_bounds(scores, bounds)


def _check_scored(scores: Scores) -> None:
    """Checks that each score has a tracking error.

    Raises:
        RunError: one has none; says why.
    """
    for run, score in scores:
        reason = score['reasons'].get('tracking_error_mm')
        if reason:
            raise RunError(f'{run} has no tracking error: {reason}')


def _scored(arguments: argparse.Namespace) -> list[dict[str, Any]]:
    """Scores each run; writes the report if requested."""
    paths = tqdm(arguments.runs, unit='run', desc='scoring', disable=None, leave=False)
    if arguments.html is None:
        return [_of(path, score_run) for path in paths]
    # plotly takes a second to import
    from push_bag.report.report import report_html  # noqa: PLC0415

    scored = [_of(path, _run_and_score) for path in paths]
    write_atomically(arguments.html, report_html(scored).encode())
    return [score for _, score in scored]


def _run_and_score(path: Path) -> tuple[RunSeries, dict[str, Any]]:
    run = read_run(path)
    return run, score_series(run)


def _of(path: Path, work: Callable[[Path], T]) -> T:
    """The result of `work` for a bag; adds the path of the bag to its errors."""
    try:
        return work(path)
    except InputError as error:
        raise InputError(str(error) if str(path) in str(error) else f'{path}: {error}') from error


def _text(arguments: argparse.Namespace, scores: Scores) -> str:
    if arguments.compare:
        return comparison_table(scores)
    if len(scores) == 1:
        score = scores[0][1]
        return json_text(score) if arguments.json else score_table(score)
    if arguments.json:
        return json_text(runs_object(scores))
    return runs_table(scores)


if __name__ == '__main__':
    sys.exit(main())
