"""The status of a node on /diagnostics."""

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node

from push_node import interface

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR
Finding: TypeAlias = tuple[bytes, str]
"""Level and message."""
UNPUBLISHED = 'unpublished'
"""Key in the recorder's status: topics that it recorded and that have no publisher now."""


def worst(findings: Iterable[Finding], otherwise: str) -> Finding:
    """The highest level among findings, with all messages of that level; else OK.

    Args:
        findings: those with an empty message do not count.
        otherwise: message if there is none.
    """
    found = [(level, message) for level, message in findings if message]
    highest = max((level for level, _ in found), default=OK)
    messages = [message for level, message in found if level == highest]
    return highest, '; '.join(messages) or otherwise


def above(value: float, warn: float, error: float, message: str) -> Finding:
    """A finding that the value exceeds a threshold, with an empty message if it does not."""
    if value > error:
        return ERROR, message
    return WARN, message if value > warn else ''


def status_name(node_name: str, name: str) -> str:
    """Name on /diagnostics of a status of a node, given by its fully qualified name."""
    return f'{node_name}: {name}'


class Reporter:
    """Publishes one named status of one node."""

    def __init__(self, node: Node, name: str) -> None:
        self._node = node
        self._name = status_name(node.get_fully_qualified_name(), name)
        self._publisher = interface.DIAGNOSTICS.publisher(node)

    def report(self, level: bytes, message: str, values: Mapping[str, str]) -> None:
        """Publishes the status; call it once a second and on every change."""
        status = DiagnosticStatus(
            level=level,
            name=self._name,
            message=message,
            hardware_id=self._node.get_namespace(),
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self._node.get_clock().now().to_msg()
        self._publisher.publish(array)
