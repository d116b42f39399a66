"""Watches whether the recorder of this cell is recording."""

import time

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from push_node import interface
from push_node.diagnostics import UNPUBLISHED, status_name
from rclpy.node import Node

FRESH = 2.0  # [s]; the recorder reports twice a second
_GRACE = 0.3  # [s] in which reports that waited during a freeze of the host are still read


class RecorderWatch:
    """Follows the recorder's status on /diagnostics."""

    def __init__(self, node: Node) -> None:
        namespace = node.get_namespace().rstrip('/')
        self._name = status_name(f'{namespace}/recorder', 'recording')
        self._last_good = -FRESH
        self._message = self._unpublished = ''
        self._quiet_since: float | None = None
        interface.DIAGNOSTICS.subscription(node, self._on_diagnostics)

    @property
    def is_recording(self) -> bool:
        """Whether the recorder reported no error within FRESH."""
        return time.monotonic() - self._last_good < FRESH

    @property
    def obstacle(self) -> str:
        """What the start waits for, with the recorder's own reason; empty while it records."""
        unheard = f'it hears no publisher of {self._unpublished}' if self._unpublished else ''
        reason = self._message or unheard
        if self.is_recording and not unheard:
            return ''
        return f'waiting for the recorder{": " if reason else ""}{reason}'

    def failure(self) -> str:
        """Why nothing is recorded, for _GRACE now; empty while it is. Call it periodically."""
        if self.is_recording:
            self._quiet_since = None
            return ''
        now = time.monotonic()
        if self._quiet_since is None:
            self._quiet_since = now
        return self._reason() if now - self._quiet_since >= _GRACE else ''

    def _reason(self) -> str:
        if self._message:
            return f'the recorder does not record: {self._message}'
        return f'no report from the recorder for {FRESH:g} s'

    def _on_diagnostics(self, array: DiagnosticArray) -> None:
        for status in array.status:
            if status.name == self._name:
                good = status.level != DiagnosticStatus.ERROR
                self._last_good = time.monotonic() if good else -FRESH
                self._message = '' if good else status.message
                values = {each.key: each.value for each in status.values}
                self._unpublished = values.get(UNPUBLISHED, '')
