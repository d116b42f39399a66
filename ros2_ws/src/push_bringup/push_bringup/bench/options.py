"""Options that benchmarks share, and how they print their results."""

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from push_core.common import InputError, Parser, check_place, finite, json_text, usable_cores
from push_mpc.settings import CONTROLLERS

from push_bringup.bench.tables import TABLES
from push_bringup.experiment import LapStore


def add_lap_options(parser: Parser, laps: Path) -> None:
    """The options of every benchmark that pushes laps."""
    parser.add_argument(
        '--jobs', type=int, default=usable_cores(), help='processes (default %(default)s)'
    )
    parser.add_argument('--json', action='store_true', help='print one JSON object instead')
    parser.add_argument('--html', type=Path, metavar='FILE', help='also write a page with figures')
    parser.add_argument(
        '--laps-file',
        type=Path,
        default=laps,
        metavar='FILE',
        help='finished laps, so that an interrupted run continues (default %(default)s)',
    )
    parser.add_argument('--fresh', action='store_true', help='ignore the laps in that file')


def add_controllers(parser: Parser) -> None:
    """The option that chooses the controllers."""
    parser.add_argument(
        '--controllers', choices=tuple(CONTROLLERS), nargs='+', default=list(CONTROLLERS)
    )


def add_controller(parser: Parser) -> None:
    """The option that chooses one controller, and that of its model."""
    parser.add_argument('--controller', choices=tuple(CONTROLLERS), default='gp')
    add_model(parser)


def add_model(parser: Parser) -> None:
    """The option that names a model file."""
    parser.add_argument(
        '--model', metavar='FILE', help='of the gp controller; default: 200 simulated pushes'
    )


def opened_store(arguments: argparse.Namespace) -> LapStore:
    """The file of laps that the options name.

    Raises:
        InputError: it cannot be used, or a number is out of range.
    """
    check_positive('--jobs', arguments.jobs)
    if arguments.html is not None:
        check_place(arguments.html)
    return LapStore(arguments.laps_file, arguments.fresh)


def check_positive(name: str, value: int) -> None:
    """Refuses numbers below 1.

    Raises:
        InputError: it is one.
    """
    if value < 1:
        raise InputError(f'{name} is {value}, must be at least 1')


def print_results(arguments: argparse.Namespace, bench: str, results: Mapping[str, Any]) -> None:
    """Prints the results of a benchmark: as JSON with `--json`, else as a Markdown table."""
    sys.stdout.write(json_text(results) if arguments.json else TABLES[bench](finite(results)))
