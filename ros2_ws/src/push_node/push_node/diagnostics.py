"""The status of a node on /diagnostics."""

from collections.abc import Mapping

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from push_node import interface


def status_name(node_name: str, name: str) -> str:
    """Name on /diagnostics of a status of a node, given by its fully qualified name."""
    return f'{node_name}: {name}'


class Reporter:
    """Publishes one named status of one node."""

    def __init__(self, node: Node, name: str) -> None:
        self._node = node
        self._name = status_name(node.get_fully_qualified_name(), name)
        self._publisher = interface.DIAGNOSTICS.publisher(node)

    def report(self, ok: bool, message: str, values: Mapping[str, str]) -> None:
        """Publishes the status; call it once a second and on every change."""
        status = DiagnosticStatus(
            level=DiagnosticStatus.OK if ok else DiagnosticStatus.ERROR,
            name=self._name,
            message=message,
            hardware_id=self._node.get_namespace(),
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(array)
