"""Floods a running cell with random well-formed messages on every topic and service.

Nothing may crash, and the tip may not move beyond its limits. Resets and perturbations put object
and tip elsewhere, so that they are called in a second part, in which only crashes count.
"""

import argparse
import random
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path

import rclpy
from push_bringup.faults import Case, Outcome
from push_bringup.faults.bed import Bed
from push_bringup.faults.case import Fault
from push_bringup.faults.verdict import problems
from push_core.common import Parser, run_command
from push_node import interface
from push_node.spin import stop_on_signals
from push_node.start_ros import init_ros
from random_messages import random_message

# all that a node subscribes to, but what this tool judges by
WITNESSES = (interface.GROUND_TRUTH, interface.CONTROLLER_STATE, interface.CLOCK)
INPUTS = tuple(topic for topic in interface.TOPICS if topic not in WITNESSES)
TELEPORTS = (interface.RESET, interface.RESET_TO_PLAN, interface.PERTURB)
BURST = 20  # messages between two looks at the cell
EPILOG = """
Example: scripts/in_env python tests/tools/random_input/flood.py --seconds 60
"""


def main(argv: Sequence[str] | None = None) -> int:
    """Floods a cell."""
    parser = Parser(description=__doc__, epilog=EPILOG)
    parser.add_argument('--seconds', type=float, default=60.0, help='of each part')
    parser.add_argument('--seed', type=int, default=0, help='of the messages')
    return run_command(parser, work, argv)


def work(arguments: argparse.Namespace) -> int:
    """Runs both parts; returns 1 if a node crashed or a limit was exceeded."""
    stop_on_signals()
    init_ros()
    case = Case('flood', Fault('', Outcome.RESTS, lambda *_: 0.0), 'realtime', arguments.seed)
    with tempfile.TemporaryDirectory(prefix='push_flood_') as name:
        bed = Bed(case, Path(name), f'flood{time.time_ns() // 1000 % 10**9}', relayed=False)
        try:
            bed.begin(1.0)
            sent = flood(bed, random.Random(arguments.seed), arguments.seconds, teleports=False)
            bed.spin(1.0)
            # the commands that were seen are those of this tool
            bed.observer.seen.commands.clear()
            found = problems(case, bed.observer.seen, bed.now(), 0.0, '')
            sent += flood(bed, random.Random(arguments.seed), arguments.seconds, teleports=True)
            bed.processes.check()
        finally:
            bed.close()
            rclpy.try_shutdown()
    sys.stdout.write(f'{sent} messages and requests; {"; ".join(found) or "nothing moved"}\n')
    return 1 if found else 0


def flood(bed: Bed, chance: random.Random, seconds: float, *, teleports: bool) -> int:
    """Sends for a time [s]; returns how many messages and requests.

    Raises:
        RunError: a node has ended.
    """
    publishers = [(topic.publisher(bed.node), topic.message_class) for topic in INPUTS]
    services = [each for each in interface.SERVICES if teleports or each not in TELEPORTS]
    clients = [(service.client(bed.node), service.service_class) for service in services]
    end, sent = time.monotonic() + seconds, 0
    while time.monotonic() < end:
        for _ in range(BURST):
            publisher, kind = chance.choice(publishers)
            publisher.publish(random_message(kind, chance))
        client, service = chance.choice(clients)
        if client.service_is_ready():
            client.call_async(random_message(service.Request, chance))
        sent += BURST + 1
        bed.spin(0.02)
        bed.processes.check()
    for publisher, _ in publishers:
        bed.node.destroy_publisher(publisher)
    return sent


if __name__ == '__main__':
    sys.exit(main())
