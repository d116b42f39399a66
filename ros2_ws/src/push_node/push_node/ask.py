"""Service calls that are repeated until a response arrives.

While the nodes discover each other, a server may not know its client yet. It then drops the
response, and the request has to be sent again.
"""

import time
from collections.abc import Callable
from typing import Any, TypeAlias

from rclpy.client import Client

WaitsFor: TypeAlias = Callable[[Callable[[], bool], float], bool]
"""Spins until a condition holds, at most for a timeout [s]; returns whether it holds."""

READY_TIMEOUT = 30.0  # [s]
RESPONSE_TIMEOUT = 2.0  # [s] of one attempt
ATTEMPTS = 10


def ask(client: Client, request: object, waits_for: WaitsFor) -> Any:
    """Calls a service; returns its response, or None if there is no service or no response.

    The service must be idempotent: the request may be sent again.
    """
    if not waits_for(client.service_is_ready, READY_TIMEOUT):
        return None
    for _ in range(ATTEMPTS):
        future = client.call_async(request)
        if waits_for(future.done, RESPONSE_TIMEOUT):
            return future.result()
    return None


class RepeatedRequest:
    """A request that is sent again until a response comes, for nodes that must not wait."""

    def __init__(self, client: Client, request: object) -> None:
        """Sends nothing yet."""
        self._client, self._request = client, request
        self._future: Any = None
        self._sent = -RESPONSE_TIMEOUT

    def response(self) -> Any | None:
        """The response, None until it has come; call it periodically."""
        if self._future is not None and self._future.done():
            return self._future.result()
        late = time.monotonic() - self._sent >= RESPONSE_TIMEOUT
        if late and self._client.service_is_ready():
            self._future, self._sent = self._client.call_async(self._request), time.monotonic()
        return None
