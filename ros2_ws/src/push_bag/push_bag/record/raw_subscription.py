"""Receives serialized messages with the times and sequence numbers of the middleware."""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from rclpy.event_handler import QoSSubscriptionEventType, UnsupportedEventTypeError
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy

from push_bag.file import message_class

DEPTH = 1000  # best-effort messages that may wait between two polls


class ReceivedMessage(NamedTuple):
    """One serialized message, its times [ns], and its number by its publisher."""

    data: bytes
    received_ns: int
    published_ns: int
    sequence: int


class RawSubscription:
    """A polled subscription.

    Polled because rclpy's EventsExecutor does not pass times and sequence numbers to callbacks.
    """

    def __init__(self, node: Node, topic: str, type_name: str, offered: QoSProfile) -> None:
        """Subscribes.

        Args:
            node: must be in no executor.
            topic: full name.
            type_name: in three parts.
            offered: QoS of the publishers; the subscription requests no more.

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

    def accepts(self, offered: QoSProfile) -> bool:
        """Whether the subscription is compatible with a publisher's QoS."""
        request = _matching(offered)
        return bool(
            self._profile.reliability in (request.reliability, ReliabilityPolicy.BEST_EFFORT)
            and self._profile.durability in (request.durability, DurabilityPolicy.VOLATILE)
        )

    def close(self) -> None:
        """Ends the subscription."""
        self._node.destroy_subscription(self._subscription)

    @property
    def middleware_lost(self) -> int:
        """Messages that the middleware reports as lost; 0 if it does not report losses."""
        if self._loss_event is None:
            return 0
        with self._loss_event:
            return int(self._loss_event.take_event().total_count)

    def take_all(self) -> Iterator[ReceivedMessage]:
        """All messages received since the last call, oldest first."""
        handle = self._subscription.handle
        with handle:
            while (taken := handle.take_message(self._type, True)) is not None:
                data, info = taken
                yield ReceivedMessage(
                    data,
                    info['received_timestamp'],
                    info['source_timestamp'],
                    info['publication_sequence_number'] or 0,
                )


def weakest(offered: Sequence[QoSProfile]) -> QoSProfile:
    """The weakest QoS among these publishers; a subscription with it is compatible with all."""
    reliable = all(each.reliability == ReliabilityPolicy.RELIABLE for each in offered)
    latched = all(each.durability == DurabilityPolicy.TRANSIENT_LOCAL for each in offered)
    return QoSProfile(
        history=offered[0].history,
        depth=offered[0].depth,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def _loss_event(subscription: Any) -> Any:
    """The event of lost messages, polled like the messages; None if not supported."""
    kind = QoSSubscriptionEventType.RCL_SUBSCRIPTION_MESSAGE_LOST
    try:
        with subscription.handle:
            return rclpy_implementation.EventHandle(subscription.handle, kind)
    except UnsupportedEventTypeError:
        return None


def _ignore(_message: object) -> None:
    """Is never called, as the node is in no executor."""


def _matching(offered: QoSProfile) -> QoSProfile:
    reliable = offered.reliability == ReliabilityPolicy.RELIABLE
    latched = offered.durability == DurabilityPolicy.TRANSIENT_LOCAL
    return QoSProfile(
        # a reliable publisher keeps what finds no room here until there is room
        history=HistoryPolicy.KEEP_ALL if reliable else HistoryPolicy.KEEP_LAST,
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
