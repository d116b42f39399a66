"""`push_bag replay RUN`: publishes a bag with its timing and QoS, or recomputes its commands."""

import argparse
import itertools
import math
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import rclpy
from push_core.common import InputError, Parser, run_command
from push_node.start_ros import init_ros
from rclpy.node import Node

from push_bag.commands.recompute import (
    add_recompute_arguments,
    ask,
    check_recompute_arguments,
    recompute,
)
from push_bag.file import BagReader, Record, Topic
from push_bag.replay import (
    Publishers,
    Survey,
    check_graph,
    from_time,
    in_order,
    is_command,
    play,
    solved_again,
    survey,
    unless_a_plant_listens,
)

DISCOVERY_TIME = 2.0  # [s] enough for the recorder, which looks for publishers once a second
REPLAYING = {
    'rate': 1.0,
    'topics': None,
    'start': 0.0,
    'delay': DISCOVERY_TIME,
    'loop': False,
    'clock': False,
    'with_commands': False,
    'drive': False,
}
"""Options of publishing, with their defaults."""
MATCHING_TIMEOUT = 5.0  # [s] for discovered subscribers to be matched
EPILOG = """
examples:
  ros2 run push_bag replay runs/RUN --rate 2 --start 5
  ros2 run push_bag replay runs/RUN --topics object_pose pusher_pose --clock
  ros2 run push_bag replay runs/RUN --recompute
  ros2 run push_bag replay runs/RUN --ask
  ros2 run push_bag replay runs/RUN --recompute --param weights.contact:=100.0 --html overlay.html
  ros2 run push_bag replay runs/RUN --qp 1234

Commands are left out unless --with-commands is given. Where a node publishes the poses already, or
would execute the commands, the replay refuses; --drive lets a plant execute them.

--recompute publishes nothing: it gives the recorded poses to the controller and compares the
computed commands with the recorded ones. Status 0 if they are equal bit for bit, 1 if not. With
--controller, --model or --param it prints the differences, and the status is 0.

--qp computes the run again up to a tick (`tick` in controller_state), and solves the QPs of that
tick once more, as the controller does and to higher accuracy: why did the solver fail there?

--ask does what --recompute does with a running mpc_node: it starts the node where the recorded
one was started, sends it each pair of poses with the recorded time, and waits for its command. To
start the nodes:
  ros2 run push_bag info runs/RUN --extract parts
  ros2 run push_gp gp_server --ros-args --params-file parts/params.yaml -p model:=parts/MODEL.npz
  ros2 run push_mpc mpc_node --ros-args --params-file parts/params.yaml -p mode:=lockstep \\
      -p require_recorder:=false
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Replays a bag."""
    return run_command(_parser(), _work, argv)


def _parser() -> Parser:
    parser = Parser('Publishes a bag with its recorded timing and QoS.', EPILOG)
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    parser.add_argument('--rate', type=float, default=1.0, help='playback speed; default 1')
    parser.add_argument('--topics', nargs='+', metavar='NAME', help='publish only these')
    parser.add_argument('--start', type=float, default=0.0, metavar='S', help='skip S seconds')
    parser.add_argument(
        '--delay',
        type=float,
        default=DISCOVERY_TIME,
        metavar='S',
        help='time to wait for subscribers before the first message; default %(default)s',
    )
    parser.add_argument('--loop', action='store_true', help='repeat until Ctrl-C')
    parser.add_argument(
        '--clock', action='store_true', help='also publish /clock, for nodes with use_sim_time'
    )
    parser.add_argument(
        '--with-commands', action='store_true', help='also publish the commands of the tip'
    )
    parser.add_argument(
        '--drive', action='store_true', help='even if a plant executes them; it moves'
    )
    add_recompute_arguments(parser)
    return parser


def _work(arguments: argparse.Namespace) -> int:
    check_recompute_arguments(arguments, REPLAYING)
    if arguments.recompute:
        return recompute(arguments)
    if arguments.ask:
        return ask(arguments)
    if arguments.qp is not None:
        sys.stdout.write(solved_again(arguments.run, arguments.qp))
        return 0
    if not arguments.rate > 0:
        raise InputError(f'--rate must be above 0, not {arguments.rate:g}')
    for name in ('start', 'delay'):
        if not 0 <= getattr(arguments, name) < math.inf:
            raise InputError(f'--{name} must not be below 0, not {getattr(arguments, name):g}')
    if arguments.drive and not arguments.with_commands:
        raise InputError('--drive needs --with-commands')
    bag = survey(arguments.run, arguments.topics)
    if arguments.start > bag.seconds:
        raise InputError(f'--start {arguments.start:g} is after the end at {bag.seconds:.2f} s')
    # Python keeps handling Ctrl-C, so that it ends the wait for the next message
    init_ros()
    try:
        _replay(rclpy.create_node('replay'), bag, arguments)
    finally:
        rclpy.try_shutdown()
    return 0


def _replay(node: Node, bag: Survey, arguments: argparse.Namespace) -> None:
    topics = _topics(bag, arguments)
    check_graph(node, [topic.name for topic in topics], arguments.drive)
    publishers = Publishers(node, topics, arguments.clock)
    _check_left_out(publishers, bag, arguments)
    time.sleep(arguments.delay)
    publishers.wait_until_matched(MATCHING_TIMEOUT)
    if not publishers.have_subscribers:
        sys.stderr.write('replay: no topic has a subscriber; --delay S waits longer\n')
    publish = publishers.publish if arguments.drive else unless_a_plant_listens(node, publishers)
    for _ in itertools.count() if arguments.loop else range(1):
        records = _records(arguments, bag, publishers)
        count = play(records, publish, arguments.rate, bag.seconds - arguments.start)
        sys.stdout.write(f'{count} messages on {len(publishers.names)} topics replayed\n')
        sys.stdout.flush()


def _topics(bag: Survey, arguments: argparse.Namespace) -> list[Topic]:
    """The topics to publish: commands only where they are asked for.

    Raises:
        InputError: there is none left.
    """
    topics = list(bag.topics.values())
    if arguments.with_commands:
        return topics
    others = [topic for topic in topics if not is_command(topic.name)]
    if not others:
        raise InputError('commands are published only with --with-commands')
    for topic in topics:
        if is_command(topic.name):
            sys.stderr.write(
                f'replay: left out {topic.name}: commands are published with --with-commands\n'
            )
    return others


def _check_left_out(publishers: Publishers, bag: Survey, arguments: argparse.Namespace) -> None:
    """Names the topics that are not replayed.

    Raises:
        InputError: they were asked for, or there is no other.
    """
    left_out = [f'{name}: {reason}' for name, reason in publishers.left_out.items()]
    if left_out and (arguments.topics or not publishers.names):
        raise InputError(left_out[0])
    left_out += [
        f'{name}: its messages of type {kind} (it has those of {bag.topics[name].type_name}, too)'
        for name, kind in sorted(bag.further_types)
    ]
    for name in publishers.redefined:
        sys.stderr.write(
            f'replay: {name}: the installed {bag.topics[name].type_name} differs from the '
            'recorded one, so subscribers may misread it\n'
        )
    for each in left_out:
        sys.stderr.write(f'replay: left out {each}\n')


def _records(
    arguments: argparse.Namespace, bag: Survey, publishers: Publishers
) -> Iterator[Record]:
    reader = BagReader(arguments.run)
    records = filter(publishers.takes, reader.records(publishers.names))
    begin = bag.first_ns + round(arguments.start * 1e9)
    return from_time(begin, in_order(records, bag.disorder_ns))


if __name__ == '__main__':
    sys.exit(main())
