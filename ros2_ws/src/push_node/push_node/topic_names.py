"""Names of topics as users write them, and in full."""

from push_core.common import InputError
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node


def full_name(node: Node, name: str) -> str:
    """A topic, or a pattern of topics such as `/arm/*`, with the node's namespace before it.

    Raises:
        InputError: no topic can have this name.
    """
    if any(letter in name for letter in '*?['):
        return name if name.startswith('/') else f'{node.get_namespace().rstrip("/")}/{name}'
    try:
        return str(node.resolve_topic_name(name))
    except (InvalidTopicNameException, RuntimeError, ValueError):
        raise InputError(f'no topic can be called {name!r}') from None
