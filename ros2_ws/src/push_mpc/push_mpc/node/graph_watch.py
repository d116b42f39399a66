"""Watches the graph for other nodes that command the tip."""

from push_node import interface
from rclpy.node import Node


class GraphWatch:
    """Looks at the publishers of the command topic."""

    def __init__(self, node: Node) -> None:
        self._node = node

    def other_commanders(self) -> str:
        """Names of the other nodes that publish commands, empty without any."""
        topic = interface.PUSHER_VELOCITY_CMD.name
        own = self._node.get_fully_qualified_name()
        names = [
            f'{each.node_namespace.rstrip("/")}/{each.node_name}'
            for each in self._node.get_publishers_info_by_topic(topic)
        ]
        # removes one name only: a second node of the same name is another commander
        if own in names:
            names.remove(own)
        return ', '.join(sorted(names))

    def warning(self) -> str:
        """A line that names the other commanders, empty without any."""
        others = self.other_commanders()
        return f'{others} commands the tip as well' if others else ''
