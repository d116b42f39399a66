"""Full names of the topics that users name."""

from push_core.common import InputError
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node


def full_name(node: Node, name: str) -> str:
    """The full name of a topic, or of a pattern of topics such as `/arm/*`.

    Raises:
        InputError: it is not a valid name.
    """
    if any(letter in name for letter in '*?['):
        return name if name.startswith('/') else f'{node.get_namespace().rstrip("/")}/{name}'
    try:
        return str(node.resolve_topic_name(name))
    except (InvalidTopicNameException, RuntimeError, ValueError):
        raise InputError(f'{name!r} is not a valid topic name') from None
