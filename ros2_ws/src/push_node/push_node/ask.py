"""Service calls that are repeated until a response arrives.

While the nodes discover each other, a server may not know its client yet. It then drops the
response, and the request has to be sent again.
"""

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
