"""Publishes the records of a bag at their recorded times."""

import contextlib
import heapq
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from push_core.common import InputError
from push_node.interface import CLOCK
from push_node.stamps import to_stamp
from rclpy.exceptions import InvalidTopicNameException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy
from rosgraph_msgs.msg import Clock
from tqdm import tqdm

from push_bag.file import Record, Topic, installed_definition, message_class, qos_profile

MATCHING_PERIOD = 0.02  # [s]
RCLError: type[Exception] = rclpy_implementation.RCLError


def in_order(records: Iterable[Record], disorder_ns: int) -> Iterator[Record]:
    """The records sorted by log time.

    Args:
        records: in the order of the file.
        disorder_ns: how much earlier a record may be than one before it [ns]; so far is read
            ahead.
    """
    waiting: list[tuple[int, int, Record]] = []
    for number, record in enumerate(records):
        heapq.heappush(waiting, (record.log_ns, number, record))
        while waiting[0][0] < record.log_ns - disorder_ns:
            yield heapq.heappop(waiting)[2]
    while waiting:
        yield heapq.heappop(waiting)[2]


def from_time(begin_ns: int, records: Iterable[Record]) -> Iterator[Record]:
    """The records from a log time [ns] on, after the last earlier one of each latched topic."""
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
    """Whether the topic is transient-local: late subscribers receive the last message."""
    return bool(qos_profile(topic.qos).durability == DurabilityPolicy.TRANSIENT_LOCAL)


def play(
    records: Iterable[Record],
    publish: Callable[[Record], None],
    rate: float,
    seconds: float,
    clock: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
) -> int:
    """Publishes each record at its recorded time after the first one.

    Args:
        records: sorted by log time.
        publish: publishes one record.
        rate: playback speed relative to recorded time.
        seconds: recorded time to play, for the progress bar.
        clock: returns the time of a steady clock [s].
        sleep: waits for a time [s].

    Returns:
        Number of records published.
    """
    count, start, first_ns = 0, clock(), None
    with tqdm(total=round(seconds, 2), unit='s', desc='replaying', disable=None) as bar:
        for record in records:
            first_ns = record.log_ns if first_ns is None else first_ns
            recorded = (record.log_ns - first_ns) * 1e-9
            if (wait := start + recorded / rate - clock()) > 0:
                sleep(wait)
            publish(record)
            bar.update(max(recorded - bar.n, 0.0))
            count += 1
    return count


class Publishers:
    """Publishes serialized records with the types and QoS profiles of the bag.

    Attributes:
        left_out: reasons by topic, for topics that cannot be published.
        redefined: topics whose type is defined otherwise in the bag than in the installed package.
    """

    def __init__(self, node: Node, topics: Iterable[Topic], with_clock: bool = False) -> None:
        """Creates a publisher for each topic.

        Args:
            node: to publish with.
            topics: of the bag.
            with_clock: whether to publish each record's log time on /clock, unless the bag has it.
        """
        self._node = node
        self._publishers: dict[str, Any] = {}
        self._types: dict[str, str] = {}
        self.left_out: dict[str, str] = {}
        self.redefined: list[str] = []
        for topic in topics:
            self._add(topic)
        needs_clock = with_clock and CLOCK.name not in self._publishers
        self._clock = CLOCK.publisher(node) if needs_clock else None

    def wait_until_matched(self, timeout: float) -> None:
        """Waits until all discovered subscribers are matched, at most `timeout` [s]."""
        end = time.monotonic() + timeout
        while time.monotonic() < end and not all(
            publisher.get_subscription_count() >= self._node.count_subscribers(name)
            for name, publisher in self._publishers.items()
        ):
            time.sleep(MATCHING_PERIOD)

    @property
    def names(self) -> set[str]:
        """Names of the topics that are published."""
        return set(self._publishers)

    def takes(self, record: Record) -> bool:
        """Whether a record is of a type that is published on its topic."""
        return self._types.get(record.topic.name) == record.topic.type_name

    @property
    def have_subscribers(self) -> bool:
        """Whether any of the topics has a subscriber."""
        return any(each.get_subscription_count() for each in self._publishers.values())

    def subscribers(self, topic: str) -> int:
        """How many subscribers of a published topic get its messages."""
        return int(self._publishers[topic].get_subscription_count())

    def publish(self, record: Record) -> None:
        """Publishes one record, after its time on /clock.

        Raises:
            InputError: the message is not of its topic's type.
        """
        if self._clock is not None:
            self._clock.publish(Clock(clock=to_stamp(record.log_ns)))
        try:
            self._publishers[record.topic.name].publish(record.data)
        except RCLError:
            topic = record.topic
            raise InputError(f'a message on {topic.name} is not a {topic.type_name}') from None

    def _add(self, topic: Topic) -> None:
        try:
            self._publishers[topic.name] = _publisher(self._node, topic)
            self._types[topic.name] = topic.type_name
        except InputError as error:
            self.left_out[topic.name] = str(error)
            return
        with contextlib.suppress(InputError):
            if topic.type_hash not in ('', installed_definition(topic.type_name).type_hash):
                self.redefined.append(topic.name)


def _publisher(node: Node, topic: Topic) -> Any:
    if topic.encoding != 'cdr':
        raise InputError(f'its messages are {topic.encoding or "of no encoding"}, not cdr')
    kind, profile = message_class(topic.type_name), qos_profile(topic.qos)
    try:
        return node.create_publisher(kind, topic.name, profile)
    except (InvalidTopicNameException, ValueError):
        raise InputError(f'the bag has a topic of invalid name: {topic.name[:60]!r}') from None
