"""Takes messages of a topic as bytes, with the middleware's times and numbers."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from rclpy.event_handler import QoSSubscriptionEventType, UnsupportedEventTypeError
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from push_bag.file import message_class

DEPTH = 1000  # messages that may wait between two polls


class ReceivedMessage(NamedTuple):
    """One message as it came: bytes, times [ns] and the publisher's number of it."""

    data: bytes
    received_ns: int
    published_ns: int
    sequence: int


class RawSubscription:
    """A subscription that is polled.

    Its node must be in no executor: rclpy's EventsExecutor cannot hand the middleware's times and
    sequence numbers to a callback.
    """

    def __init__(self, node: Node, topic: str, type_name: str, offered: QoSProfile) -> None:
        """Subscribes.

        Args:
            node: in no executor.
            topic: full name.
            type_name: in three parts.
            offered: what the publishers offer; the subscription takes all of it.

        Raises:
            InputError: the type is not installed.
        """
        self._node = node
        self._type: Any = message_class(type_name)
        self._profile = _matching(offered)
        self._subscription: Any = node.create_subscription(
            self._type, topic, _ignore, self._profile, raw=True
        )
        self._loss_event = _loss_event(self._subscription)

    def hears(self, offered: QoSProfile) -> bool:
        """Whether it asks for no more than this."""
        wanted = _matching(offered)
        return bool(
            self._profile.reliability in (wanted.reliability, ReliabilityPolicy.BEST_EFFORT)
            and self._profile.durability in (wanted.durability, DurabilityPolicy.VOLATILE)
        )

    def close(self) -> None:
        """Ends the subscription."""
        self._node.destroy_subscription(self._subscription)

    @property
    def middleware_lost(self) -> int:
        """Messages that the middleware itself says it lost; 0 where it never says."""
        if self._loss_event is None:
            return 0
        with self._loss_event:
            return int(self._loss_event.take_event().total_count)

    def take_all(self) -> Iterator[ReceivedMessage]:
        """All messages that have come since the last call, oldest first."""
        handle = self._subscription.handle
        with handle:
            while (taken := handle.take_message(self._type, True)) is not None:
                data, about = taken
                yield ReceivedMessage(
                    data,
                    about['received_timestamp'],
                    about['source_timestamp'],
                    about['publication_sequence_number'] or 0,
                )


def weakest(offered: Sequence[QoSProfile]) -> QoSProfile:
    """The profile by which all of some publishers are heard."""
    reliable = all(each.reliability == ReliabilityPolicy.RELIABLE for each in offered)
    latched = all(each.durability == DurabilityPolicy.TRANSIENT_LOCAL for each in offered)
    return QoSProfile(
        depth=offered[0].depth,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def _loss_event(subscription: Any) -> Any:
    """What tells of losses; polled like the messages, so that no executor is needed."""
    kind = QoSSubscriptionEventType.RCL_SUBSCRIPTION_MESSAGE_LOST
    try:
        with subscription.handle:
            return rclpy_implementation.EventHandle(subscription.handle, kind)
    except UnsupportedEventTypeError:
        return None


def _ignore(_message: object) -> None:
    """Never called: the node is in no executor."""


def _matching(offered: QoSProfile) -> QoSProfile:
    reliable = offered.reliability == ReliabilityPolicy.RELIABLE
    latched = offered.durability == DurabilityPolicy.TRANSIENT_LOCAL
    return QoSProfile(
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
