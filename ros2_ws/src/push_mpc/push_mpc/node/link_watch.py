"""Watches the way to the machine of the driver, and the clock there."""

import time

from diagnostic_msgs.msg import DiagnosticArray
from push_node import interface
from push_node.diagnostics import status_name
from push_node.endpoints import parameter_clients
from push_node.graph import UNNAMED, publisher_names
from push_node.stamps import to_nanoseconds, to_seconds
from rcl_interfaces.srv import GetParameters
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future

from push_mpc.estimate import LinkEstimate

_PATIENCE = 2.0  # [s] for a response; a request that is lost is not waited for


class LinkWatch:
    """Asks the node that publishes the object's pose, and reads its status on /diagnostics.

    Every node answers requests for parameters, and every driver should report its status.
    """

    def __init__(self, node: Node, tolerance: float) -> None:
        """Subscribes.

        Args:
            node: of the controller.
            tolerance: offset of the clocks [s] that is not worth a word.
        """
        self._node, self._tolerance = node, tolerance
        self._estimate = LinkEstimate()
        self._driver = ''
        self._clients: dict[str, Client] = {}
        self._sent = -_PATIENCE
        self._waiting = False
        interface.DIAGNOSTICS.subscription(node, self._on_diagnostics)

    @property
    def way(self) -> float:
        """Time [s] that a message takes to the driver; 0 while it is not known."""
        return self._estimate.way

    @property
    def fault(self) -> str:
        """How far the driver's clock is off, empty if it is not."""
        fault = self._estimate.fault(self._tolerance)
        return f'the clock of {self._driver} is {fault}; synchronise them' if fault else ''

    def values(self) -> dict[str, str]:
        """For /diagnostics."""
        return {
            'way_ms': f'{1e3 * self._estimate.way:.2f}',
            'clock_behind_ms': f'{1e3 * self._estimate.offset:.2f}',
        }

    def poll(self) -> None:
        """Sends a request if the last one is answered or lost; call it periodically."""
        drivers = publisher_names(self._node, interface.OBJECT_POSE.name)
        if len(drivers) != 1 or drivers == [UNNAMED]:
            return
        if drivers[0] != self._driver:
            self._driver, self._estimate = drivers[0], LinkEstimate()
            self._waiting = False
        now = time.monotonic()
        client = self._client()
        if (self._waiting and now - self._sent < _PATIENCE) or not client.service_is_ready():
            return
        self._sent, self._waiting = now, True
        client.call_async(GetParameters.Request()).add_done_callback(self._on_response)

    def _client(self) -> Client:
        if self._driver not in self._clients:
            self._clients[self._driver] = parameter_clients(self._node, self._driver)[1]
        return self._clients[self._driver]

    def _on_response(self, _response: Future) -> None:
        if self._waiting:
            self._waiting = False
            self._estimate.add_round_trip(time.monotonic() - self._sent)

    def _on_diagnostics(self, array: DiagnosticArray) -> None:
        own = status_name(self._driver, '')
        if self._driver and any(status.name.startswith(own) for status in array.status):
            now = int(self._node.get_clock().now().nanoseconds)
            self._estimate.add_age(to_seconds(now - to_nanoseconds(array.header.stamp)))
