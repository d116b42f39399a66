"""Calling a service whose answer may get lost.

While the nodes are still discovering each other a server may not know its client yet: it then
throws its answer away. Only asking again helps.
"""

from collections.abc import Callable
from typing import Any, TypeAlias

from rclpy.client import Client

WaitsFor: TypeAlias = Callable[[Callable[[], bool], float], bool]
"""Spins until a condition holds, at most for a time [s]; returns whether it holds."""

READY_TIMEOUT = 30.0  # [s]
ANSWER_TIMEOUT = 2.0  # [s] for one attempt
ATTEMPTS = 10


def ask(client: Client, request: object, waits_for: WaitsFor) -> Any:
    """The answer of a service, or None where there is no service or it does not answer.

    The request is sent again until an answer comes, so that asking twice must do no harm.
    """
    if not waits_for(client.service_is_ready, READY_TIMEOUT):
        return None
    for _ in range(ATTEMPTS):
        future = client.call_async(request)
        if waits_for(future.done, ANSWER_TIMEOUT):
            return future.result()
    return None
