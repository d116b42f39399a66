"""Tells late messages from a process that was itself not running."""


class Watchdog:
    """Detects that its own periodic call came late.

    After a freeze of the whole host, the poses of the meantime wait in the queue. Treating them as
    missing would stop a tip for no reason, so the first check after a freeze is skipped.
    """

    def __init__(self, period: float) -> None:
        """Starts watching.

        Args:
            period: time [s] between two calls.
        """
        self.period = period
        self._last = float('-inf')

    def slept(self, now: float) -> bool:
        """Whether this call, at a time [s], is more than a period late."""
        late = self._last > float('-inf') and now - self._last > 2.0 * self.period
        self._last = now
        return late
