"""The nodes that publish poses and commands, of which a cell has one each."""

import warnings

from rclpy.node import Node
from rclpy.topic_endpoint_info import TopicEndpointInfo

from push_node.endpoints import GraphTopic
from push_node.interface import OBJECT_POSE, PUSHER_POSE, PUSHER_VELOCITY_CMD

# discovery gives no depth of a publisher's history, for which rclpy warns
warnings.filterwarnings('ignore', 'A zero depth with KEEP_LAST', UserWarning)

SINGLE_SOURCE = (OBJECT_POSE, PUSHER_POSE, PUSHER_VELOCITY_CMD)
"""Topics with one publisher in a cell."""
UNNAMED = 'a node that has not told its name yet'
"""In place of a name: discovery brings it after the publisher; what is no ROS node has none."""
_NO_NAME = '_NODE_NAME_UNKNOWN_'  # of rmw_dds_common


def publisher_names(node: Node, topic: str) -> list[str]:
    """Full names of the nodes that publish a topic or `UNNAMED`, one a publisher, sorted."""
    return sorted(map(_full_name, node.get_publishers_info_by_topic(topic)))


def subscriber_names(node: Node, topic: str) -> list[str]:
    """Full names of the nodes that subscribe to a topic or `UNNAMED`, sorted."""
    return sorted(map(_full_name, node.get_subscriptions_info_by_topic(topic)))


def second_source(node: Node) -> str:
    """The first topic of poses or commands with two publishers, in words; empty without any."""
    return next(filter(None, (_conflict(node, topic) for topic in SINGLE_SOURCE)), '')


def _conflict(node: Node, topic: GraphTopic) -> str:
    names = publisher_names(node, topic.name)
    return f'{topic.name} has {len(names)} publishers: {", ".join(names)}' if names[1:] else ''


def _full_name(endpoint: TopicEndpointInfo) -> str:
    if endpoint.node_name == _NO_NAME:
        return UNNAMED
    return f'{endpoint.node_namespace.rstrip("/")}/{endpoint.node_name}'
