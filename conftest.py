"""For all tests: what a test does to the signals of its process ends with it."""

import signal
import sys
from collections.abc import Iterator

import pytest

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


@pytest.fixture(autouse=True)
def _signals_as_before() -> Iterator[None]:
    """Puts handlers and mask back: nodes and commands that run in this process change them."""
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, ())
    handlers = [signal.getsignal(number) for number in _SIGNALS]
    yield
    signal.pthread_sigmask(signal.SIG_SETMASK, mask)
    for number, handler in zip(_SIGNALS, handlers, strict=True):
        signal.signal(number, handler)
    if 'push_node.spin' in sys.modules:
        sys.modules['push_node.spin']._stop_requested = False
