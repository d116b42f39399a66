"""What runs in the graph that a bag is about to be published into."""

import time
from collections.abc import Callable, Iterable

from push_core.common import InputError
from push_node.endpoints import short_name
from push_node.graph import UNNAMED, publisher_names, subscriber_names
from push_node.interface import OBJECT_POSE, PUSHER_POSE, PUSHER_VELOCITY_CMD
from rclpy.node import Node

from push_bag.file import Record
from push_bag.replay.playback import Publishers

DISCOVERY_TIME = 1.0  # [s] for nodes that run already to answer a new one
NAMING_TIME = 1.0  # [s] from a subscriber's discovery to its name's, on busy cores
NAMING_PERIOD = 0.02  # [s]
POSES = (OBJECT_POSE.short_name, PUSHER_POSE.short_name)
ONLY_LISTEN = ('recorder_listener', 'live_listener')
"""Names of nodes that subscribe to commands without executing them."""


def is_command(topic: str) -> bool:
    """Whether a topic, in any namespace, moves the tip."""
    return short_name(topic) == PUSHER_VELOCITY_CMD.short_name


def check_graph(node: Node, topics: Iterable[str], drive: bool) -> None:
    """Checks that a replay is no second source of poses, and that no plant executes its commands.

    Args:
        node: that will publish; it may still be unknown to the others.
        topics: full names of the topics to publish.
        drive: whether a plant may execute the commands.

    Raises:
        InputError: names the topic and the nodes.
    """
    checked = [topic for topic in topics if is_command(topic) or short_name(topic) in POSES]
    if checked:
        time.sleep(DISCOVERY_TIME)
    for topic in checked:
        _check_sources(node, topic)
        if is_command(topic) and not drive:
            _check_plant(node, topic)


def unless_a_plant_listens(node: Node, publishers: Publishers) -> Callable[[Record], None]:
    """Publishes records, but no command to a plant, though it was found late or comes later.

    Args:
        node: that publishes.
        publishers: of that node.

    Returns:
        Publishes one record. It raises InputError before a command that a plant would execute.
    """
    known: dict[str, int] = {}

    def publish(record: Record) -> None:
        topic = record.topic.name
        if is_command(topic):
            count = publishers.subscribers(topic)
            if count != known.get(topic, 0):
                _wait_for_names(node, topic)
                _check_plant(node, topic)
                known[topic] = count
        publishers.publish(record)

    return publish


def _wait_for_names(node: Node, topic: str) -> None:
    end = time.monotonic() + NAMING_TIME
    while UNNAMED in subscriber_names(node, topic) and time.monotonic() < end:
        time.sleep(NAMING_PERIOD)


def _check_sources(node: Node, topic: str) -> None:
    others = publisher_names(node, topic)
    if others:
        raise InputError(
            f'{topic} is published by {", ".join(others)}; stop it, use another ROS_DOMAIN_ID, '
            'or choose other topics with --topics'
        )


def _check_plant(node: Node, topic: str) -> None:
    plants = [
        name for name in subscriber_names(node, topic) if short_name(name) not in ONLY_LISTEN
    ]
    if plants:
        raise InputError(
            f'{", ".join(plants)} would execute {topic} and move; use another ROS_DOMAIN_ID, or '
            'add --drive if it shall move'
        )
