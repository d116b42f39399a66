"""`push_bag replay RUN`: publishes a bag again, with its recorded timing and QoS."""

import argparse
import heapq
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import rclpy
from push_core.command_line import Parser, run_command
from push_core.errors import InputError
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from push_bag.message_types import message_class
from push_bag.qos_text import qos_profile
from push_bag.reader import BagReader, Record
from push_bag.topic import Topic

REORDER_NS = 1_000_000_000  # how far the recorder's polling can mix up the order in the file
DISCOVERY_TIME = 0.5  # [s] for subscribers to find the publishers before the first message


def main(argv: Sequence[str] | None = None) -> int:
    """Replays a bag."""
    return run_command(_parser(), _work, argv)


def in_order(records: Iterable[Record]) -> Iterator[Record]:
    """The records by log time, looking only REORDER_NS ahead."""
    waiting: list[tuple[int, int, Record]] = []
    for number, record in enumerate(records):
        heapq.heappush(waiting, (record.log_ns, number, record))
        while waiting[0][0] < record.log_ns - REORDER_NS:
            yield heapq.heappop(waiting)[2]
    while waiting:
        yield heapq.heappop(waiting)[2]


def play(
    records: Iterable[Record],
    publish: Callable[[Record], None],
    rate: float,
    clock: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
) -> int:
    """Hands each record on at its time after the first one.

    Args:
        records: by log time.
        publish: takes one record.
        rate: how much faster than recorded.
        clock: seconds of a steady clock.
        sleep: waits some seconds.

    Returns:
        Number of records published.
    """
    count, start, first_ns = 0, clock(), 0
    for record in records:
        first_ns = first_ns or record.log_ns
        due = start + (record.log_ns - first_ns) * 1e-9 / rate
        if (wait := due - clock()) > 0:
            sleep(wait)
        publish(record)
        count += 1
    return count


class Publishers:
    """Publishes raw records on a node, with the types and profiles that the bag states."""

    def __init__(self, node: Node, topics: Iterable[Topic]) -> None:
        """Creates a publisher for each topic.

        Raises:
            InputError: a type is not installed, or a profile is not readable.
        """
        self._publishers: dict[str, Any] = {
            topic.name: node.create_publisher(
                message_class(topic.type_name), topic.name, qos_profile(topic.qos)
            )
            for topic in topics
        }

    def publish(self, record: Record) -> None:
        """Publishes the bytes of one record."""
        self._publishers[record.topic.name].publish(record.data)


def _topics(path: Path) -> list[Topic]:
    """All topics of a bag, found by reading it once."""
    reader = BagReader(path)
    messages = sum(1 for _ in reader.records())
    if not messages:
        raise InputError(f'{reader.path} holds no messages')
    return list(reader.topics.values())


def _work(arguments: argparse.Namespace) -> None:
    if not arguments.rate > 0:
        raise InputError(f'--rate must be above 0, not {arguments.rate:g}')
    topics = _topics(arguments.run)
    # Ctrl-C stays Python's: it ends the wait for the next message
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    try:
        _replay(rclpy.create_node('replay'), topics, arguments)
    finally:
        rclpy.try_shutdown()


def _replay(node: Node, topics: list[Topic], arguments: argparse.Namespace) -> None:
    publishers = Publishers(node, topics)
    time.sleep(DISCOVERY_TIME)
    records = in_order(BagReader(arguments.run).records())
    count = play(records, publishers.publish, arguments.rate)
    sys.stdout.write(f'{count} messages on {len(topics)} topics replayed\n')


def _parser() -> Parser:
    parser = Parser('Publishes a bag again, with its recorded timing and quality of service.')
    parser.add_argument('run', type=Path, help='run folder or MCAP file')
    parser.add_argument('--rate', type=float, default=1.0, help='times as fast; default 1')
    return parser


if __name__ == '__main__':
    sys.exit(main())
