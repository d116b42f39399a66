"""One log line for each change of mode, written outside the loop."""

from collections import deque

from rclpy.impl.rcutils_logger import RcutilsLogger

from push_mpc.loop import Mode

_MOST = 100  # changes between two writes; more are dropped, oldest first


class ModeLog:
    """Collects changes of mode in the loop; a timer writes them."""

    def __init__(self) -> None:
        self._mode = Mode.IDLE
        self._changes: deque[tuple[Mode, Mode, str]] = deque(maxlen=_MOST)

    def note(self, mode: Mode, reason: str) -> None:
        """Takes the mode of a tick, and the reason of a stop or fault."""
        if mode != self._mode:
            self._changes.append((self._mode, mode, reason))
            self._mode = mode

    def write(self, logger: RcutilsLogger) -> None:
        """Writes what has been collected."""
        while self._changes:
            before, after, reason = self._changes.popleft()
            line = f'{before.name.lower()} -> {after.name.lower()}'
            if reason and before != Mode.STOPPING:
                logger.error(f'{line}: {reason}')
            else:
                logger.info(line)
