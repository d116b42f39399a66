"""The command that fits the plant to measurements: `ros2 run push_sim calibrate`."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import (
    Parser,
    check_place,
    json_text,
    run_command,
    usable_cores,
    workers,
    write_atomically,
)
from push_core.physics import Slider

from push_sim.calibration import calibration, calibration_json, calibration_table, parameter_file
from push_sim.commands.command_checks import check_jobs, check_seed
from push_sim.measured import files_hash, read_measured_data
from push_sim.settings import PROFILES, profile

EPILOG = """what happens:
Friction and support are fitted to half of the short pushes and half of the long ones on the face,
drawn by the seed, dead time and lag to the last run by name. The rest judges the fit. Deviations
are standard deviations by a bootstrap. It takes a few minutes on two cores.

examples:
  ros2 run push_sim calibrate --data ../shared/data
  ros2 run push_sim calibrate --data ../shared/data -o fitted.yaml
  ros2 run push_bringup cell --params fitted.yaml
"""


def parser() -> Parser:
    """Describes the command line."""
    described = Parser('Fits friction, support and lag of the plant to measurements.', EPILOG)
    described.add_argument('--data', type=Path, required=True, metavar='DIR', help='measurements')
    described.add_argument('--seed', type=int, default=0, help='of the split (default 0)')
    described.add_argument(
        '--profile', choices=PROFILES, default='irb120', help='plant at which the search begins'
    )
    described.add_argument(
        '-o', '--output', type=Path, metavar='FILE', help='ROS parameter file, for cell --params'
    )
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    described.add_argument(
        '--jobs', type=int, default=usable_cores(), metavar='N', help='processes (%(default)s)'
    )
    return described


def work(arguments: argparse.Namespace) -> None:
    """Fits, reports and writes.

    Raises:
        InputError: the folder holds nothing, a file is faulty, or a number is out of range.
    """
    check_jobs(arguments.jobs)
    check_seed(arguments.seed)
    if arguments.output:
        check_place(arguments.output)
    data, measured = read_measured_data(arguments.data), files_hash(arguments.data)
    with workers(arguments.jobs) as run_in:
        found = calibration(data, profile(arguments.profile), Slider(), run_in, arguments.seed)
    if arguments.output:
        content = parameter_file(found.parameters, measured)
        write_atomically(arguments.output, content.encode())
    figures = calibration_json(found, arguments.seed, measured)
    if arguments.json:
        sys.stdout.write(json_text(figures))
    else:
        sys.stdout.write(calibration_table(figures))


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command."""
    return run_command(parser(), work, argv)


if __name__ == '__main__':
    raise SystemExit(main())
