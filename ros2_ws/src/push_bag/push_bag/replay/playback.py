"""Records of a bag, published at their time."""

import heapq
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from push_core.common import InputError
from push_node.interface import CLOCK
from push_node.stamps import to_stamp
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy
from rosgraph_msgs.msg import Clock
from tqdm import tqdm

from push_bag.file import Record, Topic, message_class, qos_profile

REORDER_NS = 1_000_000_000  # how far the recorder's polling can mix up the order in the file
MATCHING_PERIOD = 0.02  # [s]


def in_order(records: Iterable[Record]) -> Iterator[Record]:
    """The records by log time, looking only REORDER_NS ahead."""
    waiting: list[tuple[int, int, Record]] = []
    for number, record in enumerate(records):
        heapq.heappush(waiting, (record.log_ns, number, record))
        while waiting[0][0] < record.log_ns - REORDER_NS:
            yield heapq.heappop(waiting)[2]
    while waiting:
        yield heapq.heappop(waiting)[2]


def skipped_to(begin_ns: int, records: Iterable[Record]) -> Iterator[Record]:
    """The records from a log time [ns] on; before it only the last of each latched topic."""
    latched: dict[str, Record] = {}
    for record in records:
        if record.log_ns < begin_ns:
            if is_latched(record.topic):
                latched[record.topic.name] = record._replace(log_ns=begin_ns)
            continue
        yield from latched.values()
        latched.clear()
        yield record


def is_latched(topic: Topic) -> bool:
    """Whether who comes late is sent the last message all the same."""
    return bool(qos_profile(topic.qos).durability == DurabilityPolicy.TRANSIENT_LOCAL)


def play(
    records: Iterable[Record],
    publish: Callable[[Record], None],
    rate: float,
    seconds: float,
    clock: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
) -> int:
    """Hands each record on at its time after the first one.

    Args:
        records: by log time.
        publish: takes one record.
        rate: how much faster than recorded.
        seconds: of recorded time, for the progress bar.
        clock: seconds of a steady clock.
        sleep: waits some seconds.

    Returns:
        Number of records published.
    """
    count, start, first_ns = 0, clock(), 0
    with tqdm(total=round(seconds, 2), unit='s', desc='replaying', disable=None) as bar:
        for record in records:
            first_ns = first_ns or record.log_ns
            recorded = (record.log_ns - first_ns) * 1e-9
            if (wait := start + recorded / rate - clock()) > 0:
                sleep(wait)
            publish(record)
            bar.update(max(recorded - bar.n, 0.0))
            count += 1
    return count


class Publishers:
    """Publishes raw records on a node, with the types and profiles that the bag states."""

    def __init__(self, node: Node, topics: Iterable[Topic], with_clock: bool = False) -> None:
        """Creates a publisher for each topic.

        Args:
            node: that publishes.
            topics: of the bag.
            with_clock: whether /clock tells each record's log time, where the bag has no clock.

        Raises:
            InputError: a type is not installed, or a name or a profile is not readable.
        """
        self._node = node
        self._publishers = {topic.name: _publisher(node, topic) for topic in topics}
        needs_clock = with_clock and CLOCK.name not in self._publishers
        self._clock = CLOCK.publisher(node) if needs_clock else None

    def wait_until_matched(self, timeout: float) -> None:
        """Waits until every listener of whom the node knows is connected, at most a time [s]."""
        end = time.monotonic() + timeout
        while time.monotonic() < end and not all(
            publisher.get_subscription_count() >= self._node.count_subscribers(name)
            for name, publisher in self._publishers.items()
        ):
            time.sleep(MATCHING_PERIOD)

    @property
    def are_heard(self) -> bool:
        """Whether anybody listens to any of the topics."""
        return any(each.get_subscription_count() for each in self._publishers.values())

    def publish(self, record: Record) -> None:
        """Publishes the bytes of one record, and before it what time it is."""
        if self._clock is not None:
            self._clock.publish(Clock(clock=to_stamp(record.log_ns)))
        self._publishers[record.topic.name].publish(record.data)


def _publisher(node: Node, topic: Topic) -> Any:
    kind, profile = message_class(topic.type_name), qos_profile(topic.qos)
    try:
        return node.create_publisher(kind, topic.name, profile)
    except (InvalidTopicNameException, ValueError):
        raise InputError(f'the bag has a topic of no valid name: {topic.name[:60]!r}') from None
