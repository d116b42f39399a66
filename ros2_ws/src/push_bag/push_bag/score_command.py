"""`push_bag score RUN`: the score of a run as a table, as JSON, as a report."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.atomic_file import write_atomically
from push_core.command_line import Parser, run_command

from push_bag.run_reader import read_run
from push_bag.score import score_json, score_series
from push_bag.score_table import score_table


def main(argv: Sequence[str] | None = None) -> int:
    """Scores a run."""
    return run_command(_parser(), _work, argv)


def _parser() -> Parser:
    parser = Parser('Scores a recorded run.')
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    parser.add_argument('--json', action='store_true', help='print one JSON object instead')
    parser.add_argument('--html', type=Path, metavar='FILE', help='also write a report')
    return parser


def _work(arguments: argparse.Namespace) -> None:
    run = read_run(arguments.run)
    score = score_series(run)
    if arguments.html is not None:
        # plotly takes a second to import: only who asks for a report waits for it
        from push_bag.report import report_html  # noqa: PLC0415

        write_atomically(arguments.html, report_html([(run, score)]).encode())
    sys.stdout.write(score_json(score) if arguments.json else score_table(score))


if __name__ == '__main__':
    sys.exit(main())
