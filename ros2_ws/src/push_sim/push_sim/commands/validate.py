"""Compares the simulator with measurements: `ros2 run push_sim validate`."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from push_core.common import Parser, check_place, json_text, run_command, usable_cores, worker_pool
from push_core.physics import Slider

from push_sim.commands.command_checks import check_jobs, read_and_tell
from push_sim.settings import PROFILES, profile
from push_sim.validation import (
    compare_with_measurements,
    validation_json,
    validation_table,
    write_validation_page,
)

EPILOG = """files in DIR and below, by the columns that they name; at least one kind must be there:
  p_y_m,beta_rad,dx_m,dy_m,dtheta_rad,distance_m
        short pushes; each is simulated from its p_y and beta
  x0_m,y0_m,theta0_rad,x1_m,y1_m,theta1_rad,tip_x0_m,tip_y0_m,tip_x1_m,tip_y1_m
        straight long pushes; each is simulated with the measured start and end of the tip
  t_s,slider_x_m,slider_y_m,slider_theta_rad,pusher_cmd_x_m,pusher_cmd_y_m,pusher_x_m,pusher_y_m
        robot runs; the commanded tip is compared through the actuator model, the object in
        windows of 0.5 s with the sensed tip

The ellipsoid is the limit surface that fits the short pushes best. A long push counts as on the
face if the measured end of the tip is within half a side, and 1 mm, of the middle of the face on
which it began.

examples:
  ros2 run push_sim validate --data ../shared/data --html validation.html
  ros2 run push_sim validate --data ../shared/data --json > validation.json
"""


def parser() -> Parser:
    """Describes the command line."""
    described = Parser('Compares the simulator with measured pushes and robot runs.', EPILOG)
    described.add_argument('--data', type=Path, required=True, metavar='DIR', help='measurements')
    described.add_argument('--profile', choices=PROFILES, default='irb120', help='of the plant')
    described.add_argument('--json', action='store_true', help='print one JSON object instead')
    described.add_argument(
        '--html', type=Path, metavar='FILE', help='also write a page of figures'
    )
    described.add_argument(
        '--jobs', type=int, default=usable_cores(), metavar='N', help='processes (%(default)s)'
    )
    return described


def work(arguments: argparse.Namespace) -> None:
    """Compares and prints.

    Raises:
        InputError: the folder has no measurements, a file is faulty, or a number is out of range.
    """
    check_jobs(arguments.jobs)
    if arguments.html:
        check_place(arguments.html)
    data = read_and_tell(arguments.data, 'validate')
    with worker_pool(arguments.jobs) as pool:
        settings = profile(arguments.profile)
        result = compare_with_measurements(data, settings, Slider(), pool.in_order)
    figures = {'profile': arguments.profile, **validation_json(result)}
    table = validation_table(figures, arguments.profile)
    if arguments.html:
        write_validation_page(arguments.html, result, arguments.profile, table)
    sys.stdout.write(json_text(figures) if arguments.json else table)


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command."""
    return run_command(parser(), work, argv)


if __name__ == '__main__':
    raise SystemExit(main())
