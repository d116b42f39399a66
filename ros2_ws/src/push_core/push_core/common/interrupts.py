"""Ctrl-C: held where it would do harm, and taken once where it may act."""

import signal
import time
from types import FrameType

INTERRUPTED = 130
"""Exit status of what Ctrl-C has ended."""
CLEAN_UP_TIME = 3.0
"""Time [s] in which a further Ctrl-C does not disturb the clean-up that the first one began."""
_SIGINT = (signal.SIGINT,)


class InterruptsHeld:
    """Within the block, Ctrl-C does not reach this thread; it acts at the end of the block."""

    def __enter__(self) -> None:
        try:
            self._before = signal.pthread_sigmask(signal.SIG_BLOCK, _SIGINT)
        except KeyboardInterrupt:
            # it came just before, so it was not held; and `with` does not call __exit__ now
            signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGINT)
            raise

    def __exit__(self, *_error: object) -> None:
        signal.pthread_sigmask(signal.SIG_SETMASK, self._before)


class InterruptOnce:
    """A signal handler that raises KeyboardInterrupt, and lets the clean-up run undisturbed."""

    def __init__(self) -> None:
        self._last = float('-inf')

    def __call__(self, _number: int, _frame: FrameType | None) -> None:
        """Raises, unless it has done so just before.

        Raises:
            KeyboardInterrupt: except within `CLEAN_UP_TIME` after the last one.
        """
        now = time.monotonic()
        if now - self._last > CLEAN_UP_TIME:
            self._last = now
            raise KeyboardInterrupt


def release_interrupts() -> None:
    """Lets Ctrl-C reach this thread; one that was held acts at once."""
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGINT)


def interrupt_is_held() -> bool:
    """Whether a Ctrl-C is held."""
    return signal.SIGINT in signal.sigpending()


def take_held_interrupt() -> bool:
    """Whether a Ctrl-C was held; it is taken with that."""
    return signal.sigtimedwait(_SIGINT, 0) is not None
