"""Watches the graph for second sources of commands and poses."""

from push_node.graph import publisher_names, second_source
from push_node.interface import PUSHER_VELOCITY_CMD
from rclpy.node import Node


class GraphWatch:
    """Looks at the publishers of the topics that have one source in a cell."""

    def __init__(self, node: Node) -> None:
        self._node = node

    def other_commanders(self) -> str:
        """Names of the other nodes that publish commands, empty without any."""
        own = self._node.get_fully_qualified_name()
        names = publisher_names(self._node, PUSHER_VELOCITY_CMD.name)
        # removes one name only: a second node of the same name is another commander
        if own in names:
            names.remove(own)
        return ', '.join(names)

    def warning(self) -> str:
        """A line that names other commanders or two sources of poses, empty without any."""
        others = self.other_commanders()
        return f'{others} commands the tip as well' if others else second_source(self._node)
