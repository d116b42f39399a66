"""A recording in progress: subscribes to topics as they appear and passes messages to a sink."""

import json
from collections.abc import Collection, Mapping
from fnmatch import fnmatchcase
from typing import Protocol

import rclpy
from push_core.common import InputError
from push_node import interface
from rclpy.node import Node
from rclpy.qos import QoSProfile

from push_bag.file import COUNTS_RECORD, Traffic, qos_text
from push_bag.record.raw_subscription import RawSubscription, weakest

LISTENER = '_listener'
"""End of the name of a node that subscribes for another."""


class RawSink(Protocol):
    """Receives the messages of a `Recording`: a `BagWriter` or a `LiveServer`."""

    @property
    def is_open(self) -> bool:
        """Whether messages can be written."""

    def add_topic(self, name: str, type_name: str, qos_yaml: str) -> None:
        """Declares a topic before its first message."""

    def write(
        self, name: str, data: bytes, log_ns: int, publish_ns: int, sequence: int = 0, /
    ) -> None:
        """Appends one serialized message; times in ns."""

    def flush(self) -> None:
        """Hands buffered messages on."""

    def add_facts(self, name: str, facts: Mapping[str, str], /) -> None:
        """Adds a named record of facts about the recording."""

    def close(self) -> None:
        """Finishes; no message follows."""


class Recording:
    """Records topics as their publishers appear; call its methods from timers.

    Attributes:
        traffic: message counts of each recorded topic.
        refused: reasons by topic, for topics that are published but cannot be recorded.
    """

    def __init__(
        self,
        node: Node,
        writer: RawSink,
        topics: Collection[str],
        offers: Mapping[str, QoSProfile],
    ) -> None:
        """Starts with nothing subscribed.

        Args:
            node: that records; gives name and namespace to the subscriptions' own node.
            writer: receives the messages: a bag writer or the live server; closed by `close`.
            topics: full names of the topics to record, or patterns such as `/arm/*`.
            offers: known QoS profiles of publishers by topic, which the bag states. Profiles of
                other topics come from discovery, which does not give the depth.
        """
        self.traffic: dict[str, Traffic] = {}
        self.refused: dict[str, str] = {}
        self._writer = writer
        self._topics = topics
        self._offers = offers
        self._subscriptions: dict[str, RawSubscription] = {}
        # in no executor: its subscriptions are polled
        self._listener: Node = rclpy.create_node(
            f'{node.get_name()}{LISTENER}',
            namespace=node.get_namespace(),
            use_global_arguments=False,
            start_parameter_services=False,
            enable_rosout=False,
        )

    def discover(self) -> None:
        """Subscribes to the topics to record that have a publisher.

        Subscribes again if a new publisher offers a weaker QoS than the subscription requests.

        Raises:
            RunError: the bag cannot be written.
        """
        for topic, types in self._listener.get_topic_names_and_types():
            if topic in self._subscriptions:
                self._resubscribe(topic, types[0])
            elif topic not in self.refused and self._is_selected(topic):
                self._subscribe(topic, types[0])

    def drain(self) -> None:
        """Writes all messages received since the last call.

        Raises:
            RunError: the bag cannot be written.
        """
        for topic, subscription in self._subscriptions.items():
            seen = self.traffic[topic]
            for received in subscription.take_all():
                taken = received
                if topic == interface.PARAMETER_EVENTS.absolute_name:
                    # each node publishes a burst as it starts, before anybody can hear it
                    taken = received._replace(sequence=seen.received + 1)
                self._writer.write(topic, *taken)
                seen.add(taken.sequence, taken.received_ns)

    def unpublished(self) -> set[str]:
        """Recorded topics of which no publisher is known now.

        Of one that begins anew all is lost until it is discovered, except on latched topics.
        """
        return {
            topic for topic in self._subscriptions if not self._listener.count_publishers(topic)
        }

    def flush(self) -> None:
        """Ends the current chunk, and updates the losses that the middleware reports.

        Raises:
            RunError: the bag cannot be written.
        """
        self._writer.flush()
        for topic, subscription in self._subscriptions.items():
            self.traffic[topic].middleware_lost = subscription.middleware_lost

    def close(self) -> None:
        """Writes the messages that still wait, and finishes the bag.

        Raises:
            RunError: the bag cannot be written.
        """
        try:
            if self._writer.is_open:
                self.drain()
                self.flush()
                self._writer.add_facts(COUNTS_RECORD, self._counts())
                self._writer.close()
        finally:
            self._listener.destroy_node()

    def _counts(self) -> dict[str, str]:
        """Received and lost messages by topic, as JSON."""
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

    def _is_selected(self, topic: str) -> bool:
        return any(fnmatchcase(topic, pattern) for pattern in self._topics)

    def _offered(self, topic: str) -> QoSProfile | None:
        """The weakest QoS among the publishers of a topic; None without a publisher."""
        publishers = self._listener.get_publishers_info_by_topic(topic)
        return weakest([each.qos_profile for each in publishers]) if publishers else None

    def _resubscribe(self, topic: str, type_name: str) -> None:
        offered = self._offered(topic)
        if offered is None or self._subscriptions[topic].accepts(offered):
            return
        # messages between the two subscriptions are counted as lost
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
