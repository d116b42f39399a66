"""`push_bag import-csv ROBOT_RUN.csv -o RUN`: converts a run of the real cell to a bag.

The file has poses and positions at about 500 Hz and no reference. The object followed a straight
line; the timing of its reference was not recorded, so the reference is timed by the object's own
progress. The score then holds lateral and heading errors only; its tracking error is the lateral
one.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import Parser, run_command
from push_core.data import read_robot_run
from push_core.physics import Slider

from push_bag.file import atomic_bag
from push_bag.robot_csv import check_contact, lost_rows, messages, reference_line, topics

EPILOG = """
Columns: t_s, slider_x_m, slider_y_m, slider_theta_rad, pusher_cmd_x_m, pusher_cmd_y_m, pusher_x_m,
pusher_y_m. The reference is the x axis, or the line that fits the object's positions if the robot
was commanded elsewhere; it is timed by the object's own progress, so the score holds the lateral
error. Rows that the log lacks count as lost messages. Commanded velocities are the slopes of the
commanded positions.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Imports a run."""
    return run_command(_parser(), _work, argv)


def import_run(path: Path, folder: Path, slider: Slider) -> str:
    """Converts a measured run to a bag.

    Args:
        path: of the CSV file.
        folder: of the new run; must not exist yet.
        slider: the object and the tip.

    Returns:
        What was imported, as lines of text.

    Raises:
        InputError: the file is not such a run, or the folder exists already.
        RunError: the bag cannot be written.
    """
    run = read_robot_run(path)
    line = reference_line(run)
    check_contact(run, slider)
    facts = {
        'mode': 'robot',
        'profile': 'robot',
        'imported_from': path.name,
        'reference': line.text,
    }
    count = 0
    with atomic_bag(folder, facts, {}) as writer:
        for topic in topics():
            writer.add_topic(*topic)
        for each in messages(run, slider, line):
            writer.write(each.topic, each.data, each.stamp, each.stamp, each.sequence)
            count += 1
    lost = int(lost_rows(run.time).sum())
    missing = f'; the log lacks {lost} rows' if lost else ''
    return f'{count} messages; the reference is {line.text}{missing}'


def _parser() -> Parser:
    parser = Parser('Converts a run of the real cell to a bag.', EPILOG)
    parser.add_argument('file', type=Path, metavar='ROBOT_RUN.csv')
    parser.add_argument(
        '-o', '--output', type=Path, required=True, metavar='RUN', help='new run folder'
    )
    parser.add_argument('--side', type=float, default=Slider().side, help='of the square [m]')
    parser.add_argument('--tip-radius', type=float, default=Slider().tip_radius, help='[m]')
    return parser


def _work(arguments: argparse.Namespace) -> None:
    slider = Slider(side=arguments.side, tip_radius=arguments.tip_radius)
    text = import_run(arguments.file, arguments.output, slider)
    sys.stdout.write(f'{text}\n{arguments.output}\n')


if __name__ == '__main__':
    sys.exit(main())
