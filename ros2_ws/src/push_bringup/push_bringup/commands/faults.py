"""`ros2 run push_bringup faults`: puts faults into running cells and checks what they lead to."""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import rclpy
from push_core.common import InputError, Parser, finite, json_text, run_command
from push_node.ros_environment import check_ros_environment
from push_node.spin import stop_on_signals
from push_node.start_ros import init_ros
from tqdm import tqdm

from push_bringup.faults import Verdict
from push_bringup.faults.campaign import cases, impossible, run_cases, summary
from push_bringup.faults.kinds import KINDS

MODES = ('realtime', 'lockstep')
EPILOG = """examples:
  ros2 run push_bringup faults --only dropout_20ms kill_mpc_node --seeds 10
  ros2 run push_bringup faults --seeds 1 --json

A case takes 5 to 15 seconds. A case during which the host took the cores away from this command
for 0.1 s is run again, up to three times; the table counts these.
Exit status: 0 every case led to what it must, 1 one did not, 2 the command was wrong.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the campaign; returns the exit status."""
    return run_command(parser(), work, argv)


def parser() -> Parser:
    """The command line."""
    described = Parser('Puts faults into running cells and checks what they lead to.', EPILOG)
    described.add_argument(
        '--only',
        nargs='+',
        choices=tuple(KINDS),
        default=list(KINDS),
        metavar='KIND',
        help=f'only these of {", ".join(KINDS)}',
    )
    described.add_argument(
        '--mode', nargs='+', choices=MODES, default=list(MODES), help='of the cells'
    )
    described.add_argument('--seeds', type=int, default=1, help='cases of each kind (default 1)')
    described.add_argument(
        '--first-seed', type=int, default=0, help='the first of the seeds (default 0)'
    )
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    described.add_argument('--html', type=Path, help='also write the table as a page')
    return described


def work(arguments: argparse.Namespace) -> int:
    """Runs the cases and prints the table.

    Raises:
        InputError: a number is out of range, or the environment lacks what ROS needs.
    """
    if arguments.seeds < 1:
        raise InputError(f'--seeds is {arguments.seeds}, must be positive')
    check_ros_environment()
    seeds = range(arguments.first_seed, arguments.first_seed + arguments.seeds)
    skipped = impossible(arguments.only)
    for kind, why in skipped.items():
        sys.stderr.write(f'faults: {kind} is skipped: {why}\n')
    kinds = [kind for kind in arguments.only if kind not in skipped]
    chosen = cases(kinds, arguments.mode, seeds)
    stop_on_signals()
    init_ros()
    try:
        with tqdm(total=len(chosen), unit='case', disable=None) as bar:
            verdicts = run_cases(chosen, lambda verdict: _tell(verdict, bar.update))
    finally:
        rclpy.try_shutdown()
    results = finite({**summary(verdicts), 'skipped': skipped})
    if arguments.html is not None:
        # plotly takes a second to import: only a page needs it
        from push_bringup.commands.faults_page import write_page  # noqa: PLC0415

        write_page(arguments.html, verdicts, results)
    sys.stdout.write(json_text(results) if arguments.json else _text(verdicts, results))
    return 1 if any(verdict.problems for verdict in verdicts) else 0


def _tell(verdict: Verdict, count: Callable[[], object]) -> None:
    count()
    if verdict.problems:
        case = verdict.case
        what = '; '.join(verdict.problems)
        sys.stderr.write(f'faults: {case.kind}, {case.mode}, seed {case.seed}: {what}\n')


HEADS = ('fault', 'must', 'cases', 'as expected', 'again', 'rest [s]', 'fastest [m/s]')


def _rows(results: dict[str, dict[str, dict[str, object]]]) -> list[list[str]]:
    return [
        [
            kind,
            str(row['expected']),
            str(row['cases']),
            str(row['as_expected']),
            str(row['again']),
            '' if row['longest_rest_s'] is None else f'{row["longest_rest_s"]:.2f}',
            f'{row["fastest_m_s"]:.3f}',
        ]
        for kind, row in results['by_fault'].items()
    ]


def _text(verdicts: Sequence[Verdict], results: dict[str, dict[str, dict[str, object]]]) -> str:
    rows = [list(HEADS), *_rows(results)]
    widths = [max(len(row[column]) for row in rows) for column in range(len(HEADS))]
    lines = [
        '  '.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
    failed = sum(bool(verdict.problems) for verdict in verdicts)
    return '\n'.join([*lines, f'{len(verdicts)} cases, {failed} not as expected', ''])


if __name__ == '__main__':
    sys.exit(main())
