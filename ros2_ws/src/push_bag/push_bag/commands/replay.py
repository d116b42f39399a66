"""`push_bag replay RUN`: publishes a bag again, with its timing and QoS, or recomputes it."""

import argparse
import itertools
import math
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import rclpy
from push_core.common import InputError, Parser, run_command
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from push_bag.commands.recompute import (
    add_recompute_arguments,
    ask,
    check_recompute_arguments,
    recompute,
)
from push_bag.file import BagReader, Record
from push_bag.replay import Publishers, Survey, in_order, play, skipped_to, survey

DISCOVERY_TIME = 2.0  # [s] for who looks for publishers once a second, as the recorder does
REPLAYING = {
    'rate': 1.0,
    'topics': None,
    'start': 0.0,
    'delay': DISCOVERY_TIME,
    'loop': False,
    'clock': False,
}
"""Options that only a replay heeds, and their defaults."""
MATCHING_TIMEOUT = 5.0  # [s] for those that were seen to be connected
EPILOG = """
examples:
  ros2 run push_bag replay runs/RUN --rate 2 --start 5
  ros2 run push_bag replay runs/RUN --topics object_pose pusher_pose --clock
  ros2 run push_bag replay runs/RUN --recompute
  ros2 run push_bag replay runs/RUN --ask
  ros2 run push_bag replay runs/RUN --recompute --param weights.contact:=100.0 --html overlay.html

--recompute publishes nothing: it gives the recorded poses to the controller and compares what it
computes with the recorded commands. Nothing changed: status 0 if they are the same bit for bit, 1
if not. With --controller, --model or --param it says how far the commands lie apart.

--ask does the same with a running mpc_node: it starts it where the recorded one was started, shows
it each pair of poses with the time that was known then, and waits for its answer. For the nodes:
  ros2 run push_bag info runs/RUN --extract parts
  ros2 run push_gp gp_server --ros-args --params-file parts/params.yaml -p model:=parts/MODEL.npz
  ros2 run push_mpc mpc_node --ros-args --params-file parts/params.yaml -p mode:=lockstep \\
      -p require_recorder:=false
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Replays a bag."""
    return run_command(_parser(), _work, argv)


def _parser() -> Parser:
    parser = Parser('Publishes a bag again, with its recorded timing and QoS.', EPILOG)
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    parser.add_argument('--rate', type=float, default=1.0, help='times as fast; default 1')
    parser.add_argument('--topics', nargs='+', metavar='NAME', help='only these; default all')
    parser.add_argument('--start', type=float, default=0.0, metavar='S', help='begin S seconds in')
    parser.add_argument(
        '--delay',
        type=float,
        default=DISCOVERY_TIME,
        metavar='S',
        help='wait for listeners before the first message; default %(default)s',
    )
    parser.add_argument('--loop', action='store_true', help='again and again, until Ctrl-C')
    parser.add_argument(
        '--clock', action='store_true', help='publish /clock too, for nodes with use_sim_time'
    )
    add_recompute_arguments(parser)
    return parser


def _work(arguments: argparse.Namespace) -> int:
    check_recompute_arguments(arguments, REPLAYING)
    if arguments.recompute:
        return recompute(arguments)
    if arguments.ask:
        return ask(arguments)
    if not arguments.rate > 0:
        raise InputError(f'--rate must be above 0, not {arguments.rate:g}')
    for name in ('start', 'delay'):
        if not 0 <= getattr(arguments, name) < math.inf:
            raise InputError(f'--{name} must not be below 0, not {getattr(arguments, name):g}')
    found = survey(arguments.run, arguments.topics)
    if arguments.start > found.seconds:
        raise InputError(f'--start {arguments.start:g} is after the end at {found.seconds:.2f} s')
    # Ctrl-C stays Python's: it ends the wait for the next message
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        _replay(rclpy.create_node('replay'), found, arguments)
    finally:
        rclpy.try_shutdown()
    return 0


def _replay(node: Node, found: Survey, arguments: argparse.Namespace) -> None:
    publishers = Publishers(node, found.topics.values(), arguments.clock)
    time.sleep(arguments.delay)
    publishers.wait_until_matched(MATCHING_TIMEOUT)
    if not publishers.are_heard:
        sys.stderr.write('replay: nobody listens yet; --delay S gives listeners more time\n')
    for _ in itertools.count() if arguments.loop else range(1):
        records = _records(arguments, found)
        count = play(records, publishers.publish, arguments.rate, found.seconds - arguments.start)
        sys.stdout.write(f'{count} messages on {len(found.topics)} topics replayed\n')
        sys.stdout.flush()


def _records(arguments: argparse.Namespace, found: Survey) -> Iterator[Record]:
    reader = BagReader(arguments.run)
    begin = found.first_ns + round(arguments.start * 1e9)
    return skipped_to(begin, in_order(reader.records(found.topics)))


if __name__ == '__main__':
    sys.exit(main())
