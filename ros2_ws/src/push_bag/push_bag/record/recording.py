"""A recording in progress: finds publishers, takes their messages, hands them to a sink."""

import json
from collections.abc import Collection, Mapping
from fnmatch import fnmatchcase
from typing import Protocol

import rclpy
from push_core.common import InputError
from rclpy.node import Node
from rclpy.qos import QoSProfile

from push_bag.file import COUNTS_RECORD, Traffic, qos_text
from push_bag.record.raw_subscription import RawSubscription, weakest


class RawSink(Protocol):
    """Takes serialized messages; a `BagWriter`, whose methods say more, or a `LiveServer`."""

    @property
    def is_open(self) -> bool:
        """Whether it takes messages."""

    def add_topic(self, name: str, type_name: str, qos_yaml: str) -> None:
        """Declares a topic before its first message."""

    def write(
        self, name: str, data: bytes, log_ns: int, publish_ns: int, sequence: int = 0, /
    ) -> None:
        """Takes one message of a topic."""

    def flush(self) -> None:
        """Hands on what waits."""

    def note(self, name: str, values: Mapping[str, str]) -> None:
        """Takes a remark on the recording."""

    def close(self) -> None:
        """Ends."""


class Recording:
    """Records topics as their publishers appear; call its methods from timers.

    Attributes:
        traffic: received and lost per recorded topic.
        refused: topics that are published but cannot be recorded, with the reason.
    """

    def __init__(
        self, writer: RawSink, topics: Collection[str], offers: Mapping[str, QoSProfile]
    ) -> None:
        """Starts with nothing subscribed.

        Args:
            writer: the open bag, or who else wants them; closed by `close`.
            topics: full names of the topics to record, or patterns of names such as `/arm/*`.
            offers: what is known of the publishers' profiles by topic; discovery does not tell
                their depth, so the bag states these where it can.
        """
        self.traffic: dict[str, Traffic] = {}
        self.refused: dict[str, str] = {}
        self._writer = writer
        self._topics = topics
        self._offers = offers
        self._subscriptions: dict[str, RawSubscription] = {}
        # its subscriptions are polled, so this node is in no executor
        self._listener: Node = rclpy.create_node(
            'recorder_listener',
            use_global_arguments=False,
            start_parameter_services=False,
            enable_rosout=False,
        )

    def discover(self) -> None:
        """Subscribes to the wanted topics that have a publisher by now.

        Anew where a publisher came that offers less than the others: it would not be heard.

        Raises:
            RunError: the bag cannot be written.
        """
        for topic, types in self._listener.get_topic_names_and_types():
            if topic in self._subscriptions:
                self._hear_all(topic, types[0])
            elif topic not in self.refused and self._is_wanted(topic):
                self._subscribe(topic, types[0])

    def drain(self) -> None:
        """Writes all messages that have come since the last call.

        Raises:
            RunError: the bag cannot be written.
        """
        for topic, subscription in self._subscriptions.items():
            seen = self.traffic[topic]
            for taken in subscription.take_all():
                self._writer.write(topic, *taken)
                seen.saw(taken.sequence, taken.received_ns)

    def flush(self) -> None:
        """Ends the chunk in progress, so that a kill loses nothing older, and asks for losses.

        Raises:
            RunError: the bag cannot be written.
        """
        self._writer.flush()
        for topic, subscription in self._subscriptions.items():
            self.traffic[topic].middleware_lost = subscription.middleware_lost

    def close(self) -> None:
        """Takes what still waits and finishes the bag.

        Raises:
            RunError: the bag cannot be written.
        """
        try:
            if self._writer.is_open:
                self.drain()
                self.flush()
                self._writer.note(COUNTS_RECORD, self._counts())
                self._writer.close()
        finally:
            self._listener.destroy_node()

    def _counts(self) -> dict[str, str]:
        """What was received and lost of each topic, for the bag."""
        return {
            topic: json.dumps(
                {
                    'received': seen.received,
                    'lost': seen.lost,
                    'middleware_lost': seen.middleware_lost,
                }
            )
            for topic, seen in self.traffic.items()
        }

    def _is_wanted(self, topic: str) -> bool:
        return any(fnmatchcase(topic, wanted) for wanted in self._topics)

    def _offered(self, topic: str) -> QoSProfile | None:
        """What all publishers of a topic offer together, None without a publisher."""
        publishers = self._listener.get_publishers_info_by_topic(topic)
        return weakest([each.qos_profile for each in publishers]) if publishers else None

    def _hear_all(self, topic: str, type_name: str) -> None:
        offered = self._offered(topic)
        if offered is None or self._subscriptions[topic].hears(offered):
            return
        # what comes between the two is counted as lost
        self.drain()
        self._subscriptions[topic].close()
        self._subscriptions[topic] = RawSubscription(self._listener, topic, type_name, offered)

    def _subscribe(self, topic: str, type_name: str) -> None:
        offered = self._offered(topic)
        if offered is None:
            return
        try:
            subscription = RawSubscription(self._listener, topic, type_name, offered)
            self._writer.add_topic(topic, type_name, qos_text(self._offers.get(topic, offered)))
        except InputError as error:
            self.refused[topic] = str(error)
            return
        self._subscriptions[topic] = subscription
        self.traffic[topic] = Traffic()
