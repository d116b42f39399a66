"""`ros2 run push_bringup check_driver`: checks a running driver against docs/robot.md."""

import argparse
import sys
from collections.abc import Iterator, Sequence

import rclpy
from push_core.common import Parser, replaced, run_command
from push_mpc.settings import MpcSettings, mpc_settings
from push_node import interface
from push_node.spin import stop_on_signals
from push_node.start_ros import init_ros
from rclpy.node import Node

from push_bringup.driver_check import Point, motion_points, pair_point, pose_points
from push_bringup.driver_check.driver_client import DISCOVERY_TIME, DriverClient

EPILOG = """examples:
  ros2 run push_bringup check_driver                  listens for 3 s
  ros2 run push_bringup check_driver --move           also moves the tip 20 mm back and forth

--move moves the tip away from the object and back, at 20 mm/s: clear 30 mm behind the tip.
Exit status: 0 every tested point is kept, 1 one is not, 2 the command was wrong.
"""
LISTENING_TIME = 3.0  # [s]
SPEED = 0.02  # [m/s]
DURATION = 1.0  # [s]


def main(argv: Sequence[str] | None = None) -> int:
    """Checks the driver; returns the exit status."""
    parser = Parser('Checks a running robot driver against the contract.', EPILOG)
    parser.add_argument('--move', action='store_true', help='test the motion of the tip as well')
    parser.add_argument(
        '--pose-timeout',
        type=float,
        metavar='S',
        default=MpcSettings().pose_timeout,
        help='pose_timeout that mpc_node will have, longer for slow cameras (default %(default)s)',
    )
    parser.add_argument('--namespace', default='', help='of the driver')
    return run_command(parser, _check, argv)


def _check(arguments: argparse.Namespace) -> int:
    settings = replaced(mpc_settings('irb120'), {'pose_timeout': arguments.pose_timeout})
    stop_on_signals()
    init_ros()
    try:
        node = Node('check_driver', namespace=arguments.namespace)
        kept = True
        for point in _points(DriverClient(node), settings, arguments.move):
            sys.stdout.write(f'{point}\n')
            sys.stdout.flush()
            kept = kept and point.kept is not False
        return 0 if kept else 1
    finally:
        rclpy.try_shutdown()


def _points(driver: DriverClient, settings: MpcSettings, move: bool) -> Iterator[Point]:
    driver.listen(DISCOVERY_TIME)
    driver.forget()
    driver.listen(LISTENING_TIME)
    graph = driver.graph_points()
    yield from graph
    poses = driver.heard(interface.OBJECT_POSE)
    tips = driver.heard(interface.PUSHER_POSE)
    yield from pose_points(poses, settings)
    yield from pose_points(tips, settings)
    yield pair_point(poses, tips, settings)
    if not move:
        yield Point('motion', None, 'give --move')
    elif all(point.kept for point in graph) and len(poses) and len(tips):
        yield from motion_points(driver.move(SPEED * driver.away(), DURATION))
    else:
        yield Point('motion', None, 'a point above must be kept first')
