"""Passes the poses of the plant on to the cell, and spoils them on request."""

from collections.abc import Callable

from geometry_msgs.msg import PoseStamped
from push_node import interface
from push_node.endpoints import GraphTopic
from rclpy.node import Node
from rclpy.qos import QoSProfile

BEHIND = 'plant/'
"""Prefix of the topics on which the plant publishes."""
TOPICS = (interface.PUSHER_POSE, interface.OBJECT_POSE)
Spoil = Callable[[PoseStamped, str], bool]
"""Changes a pose of a topic in place; returns whether it is passed on."""


def remappings() -> list[str]:
    """ROS arguments of the plant."""
    return [
        word for topic in TOPICS for word in ('-r', f'{topic.name}:={BEHIND}{topic.short_name}')
    ]


class Relay:
    """Stands between cameras and controller.

    Attributes:
        spoil: what is done to each pose; None passes all on as they are.
    """

    def __init__(self, node: Node, connected: bool) -> None:
        """Connects cameras and controller, unless they are connected without it."""
        self.spoil: Spoil | None = None
        for topic in TOPICS if connected else ():
            self._connect(node, topic)

    def _connect(self, node: Node, topic: GraphTopic) -> None:
        publisher = topic.publisher(node)

        def pass_on(message: PoseStamped) -> None:
            if self.spoil is None or self.spoil(message, topic.short_name):
                publisher.publish(message)

        deep = QoSProfile(depth=10, reliability=topic.qos.reliability)
        topic.subscription(node, pass_on, BEHIND, deep)
