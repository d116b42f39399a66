"""Publishers of a node by mode: as the interface states them, or such that no message is lost."""

import time

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, ReliabilityPolicy

from push_node.endpoints import GraphTopic

KEPT = 1000  # messages of each topic that wait for subscribers
CONFIRM_EVERY = KEPT // 4  # steps
CONFIRM_TIMEOUT = 2.0  # [s]; a subscriber that was killed never answers


class GraphPublishers:
    """Makes publishers with the QoS of the interface: in real time a late message is worthless."""

    def __init__(self, node: Node) -> None:
        """Makes publishers of `node`."""
        self._node = node

    def of(self, topic: GraphTopic) -> Publisher:
        """The publisher of a topic."""
        return topic.publisher(self._node)

    def step(self) -> None:
        """Call it after each step of the plant or tick of the controller."""

    def flush(self) -> None:
        """Waits until every subscriber has what was published, if the publishers can."""


class LosslessPublishers(GraphPublishers):
    """Makes reliable publishers, and waits for subscribers that fall behind.

    In lockstep nothing is late, so that nothing need be lost: however slow the recorder is, no
    message that it lacks leaves the history of its publisher.
    """

    def __init__(self, node: Node) -> None:
        """Makes publishers of `node`."""
        super().__init__(node)
        self._made: list[Publisher] = []
        self._steps = 0

    def of(self, topic: GraphTopic) -> Publisher:
        """The publisher of a topic; a subscriber that asks for best effort hears it as well."""
        publisher = topic.publisher(self._node, qos=lossless(topic.qos))
        self._made.append(publisher)
        return publisher

    def step(self) -> None:
        """Counts steps of at most two messages per topic; every so often, flushes."""
        self._steps += 1
        if self._steps % CONFIRM_EVERY == 0:
            self.flush()

    def flush(self) -> None:
        """Waits until every subscriber has acknowledged every message, 2 s at most."""
        deadline = time.monotonic() + CONFIRM_TIMEOUT
        for publisher in self._made:
            left = max(deadline - time.monotonic(), 0.0)
            publisher.wait_for_all_acked(Duration(seconds=left))


def lossless(qos: QoSProfile) -> QoSProfile:
    """The same QoS, but reliable and with a long history."""
    return QoSProfile(
        depth=KEPT,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=qos.durability,
        deadline=qos.deadline,
    )


PUBLISHERS: dict[str, type[GraphPublishers]] = {
    'realtime': GraphPublishers,
    'lockstep': LosslessPublishers,
}
