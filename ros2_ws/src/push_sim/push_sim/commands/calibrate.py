"""Fits the plant to measurements: `ros2 run push_sim calibrate`."""

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from push_core.common import (
    Parser,
    check_place,
    json_text,
    run_command,
    usable_cores,
    worker_pool,
    write_atomically,
)
from push_core.physics import Slider

from push_sim.calibration import (
    FittedParameter,
    calibrate_plant,
    calibrate_recorded,
    calibration_json,
    calibration_table,
    is_bag,
    read_recording,
    recorded_table,
    ros_parameter_file,
)
from push_sim.commands.command_checks import check_jobs, check_seed, read_and_tell
from push_sim.measured import measurement_files
from push_sim.settings import PROFILES, profile

EPILOG = """method:
Friction of the pusher and support radius are fitted to a random half of the short pushes and of
the long pushes on the face, dead time and lag to the last run by name. The rest is the test set.
Standard deviations come from a bootstrap. It takes a few minutes on two cores.
From a recorded run only dead time and lag are fitted, to the commands and the measured tip of its
last start, in seconds. They include the way of the messages between the machines.

examples:
  ros2 run push_sim calibrate --data ../shared/data
  ros2 run push_sim calibrate --data ../shared/data -o fitted.yaml
  ros2 run push_sim calibrate --data runs/RUN -o fitted.yaml
  ros2 run push_bringup cell --params fitted.yaml
"""


def parser() -> Parser:
    """Describes the command line."""
    described = Parser(
        'Fits friction, support radius and lag of the plant to measurements.', EPILOG
    )
    described.add_argument(
        '--data',
        type=Path,
        required=True,
        metavar='DIR',
        help='folder of measurements, or a recorded run',
    )
    described.add_argument(
        '--seed', type=int, default=0, help='of split and bootstrap (default 0)'
    )
    described.add_argument('--profile', choices=PROFILES, default='irb120', help='initial guess')
    described.add_argument(
        '-o', '--output', type=Path, metavar='FILE', help='ROS parameter file, for cell --params'
    )
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    described.add_argument(
        '--jobs', type=int, default=usable_cores(), metavar='N', help='processes (%(default)s)'
    )
    return described


def work(arguments: argparse.Namespace) -> None:
    """Fits, prints and writes.

    Raises:
        InputError: the folder has no measurements, a file is faulty, or a number is out of range.
    """
    check_jobs(arguments.jobs)
    check_seed(arguments.seed)
    if arguments.output:
        check_place(arguments.output)
    if is_bag(arguments.data):
        _fit_recording(arguments)
    else:
        _fit_measurements(arguments)


def _fit_recording(arguments: argparse.Namespace) -> None:
    recorded = read_recording(arguments.data)
    start = profile(arguments.profile).actuator
    result = calibrate_recorded(recorded, start, arguments.seed)
    data_hash = recorded.sha256()
    _write(arguments, result.parameters, data_hash)
    _tell(arguments, result.as_json(data_hash), recorded_table)


def _fit_measurements(arguments: argparse.Namespace) -> None:
    data = read_and_tell(arguments.data, 'calibrate')
    data_hash = measurement_files(arguments.data).sha256()
    start, seed = profile(arguments.profile), arguments.seed
    with worker_pool(arguments.jobs) as pool:
        result = calibrate_plant(data, start, Slider(), pool.in_order, seed)
    _write(arguments, result.parameters, data_hash)
    _tell(arguments, calibration_json(result, seed, data_hash), calibration_table)


def _write(
    arguments: argparse.Namespace, parameters: Sequence[FittedParameter], data_hash: str
) -> None:
    if arguments.output:
        content = ros_parameter_file(parameters, data_hash)
        write_atomically(arguments.output, content.encode())


def _tell(
    arguments: argparse.Namespace,
    figures: dict[str, Any],
    table: Callable[[dict[str, Any]], str],
) -> None:
    sys.stdout.write(json_text(figures) if arguments.json else table(figures))


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command."""
    return run_command(parser(), work, argv)


if __name__ == '__main__':
    raise SystemExit(main())
