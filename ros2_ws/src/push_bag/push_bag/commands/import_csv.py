"""`push_bag import-csv ROBOT_RUN.csv -o RUN`: converts a run of the real cell to a bag.

The file has poses and positions at about 500 Hz and no reference. The object followed the world's
x axis; the timing of its reference was not recorded, so the reference is timed by the object's own
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
from push_bag.robot_csv import messages, topics

EPILOG = """
Columns: t_s, slider_x_m, slider_y_m, slider_theta_rad, pusher_cmd_x_m, pusher_cmd_y_m, pusher_x_m,
pusher_y_m. The reference is the x axis, timed by the object's own progress, so the score holds the
lateral error. Commanded velocities are the slopes of the commanded positions.
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Imports a run."""
    return run_command(_parser(), _work, argv)


def import_run(path: Path, folder: Path, slider: Slider) -> int:
    """Converts a measured run to a bag.

    Args:
        path: of the CSV file.
        folder: of the new run; must not exist yet.
        slider: the object and the tip.

    Returns:
        Number of messages written.

    Raises:
        InputError: the file is not such a run, or the folder exists already.
        RunError: the bag cannot be written.
    """
    run = read_robot_run(path)
    facts = {'mode': 'robot', 'profile': 'robot', 'imported_from': path.name}
    with atomic_bag(folder, facts, {}) as writer:
        for topic in topics():
            writer.add_topic(*topic)
        numbers = dict.fromkeys(writer.counts, 0)
        for name, data, stamp in messages(run, slider):
            numbers[name] += 1
            writer.write(name, data, stamp, stamp, numbers[name])
    return sum(numbers.values())


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
    count = import_run(arguments.file, arguments.output, slider)
    sys.stdout.write(f'{count} messages\n{arguments.output}\n')


if __name__ == '__main__':
    sys.exit(main())
