"""Watches whether the recorder of this cell is recording."""

import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from push_node import interface
from push_node.diagnostics import status_name
from rclpy.node import Node

_FRESH = 3.0  # [s]; the recorder reports once a second


class RecorderWatch:
    """Follows the recorder's status on /diagnostics."""

    def __init__(self, node: Node) -> None:
        namespace = node.get_namespace().rstrip('/')
        self._name = status_name(f'{namespace}/recorder', 'recording')
        self._last_good = -_FRESH
        interface.DIAGNOSTICS.subscription(node, self._on_diagnostics)

    @property
    def is_recording(self) -> bool:
        """Whether the recorder reported OK within the last 3 s."""
        return time.monotonic() - self._last_good < _FRESH

    def _on_diagnostics(self, array: DiagnosticArray) -> None:
        for status in array.status:
            if status.name == self._name:
                good = status.level == DiagnosticStatus.OK
                self._last_good = time.monotonic() if good else -_FRESH
