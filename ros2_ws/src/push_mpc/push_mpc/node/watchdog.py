"""Tells a message that is late from a process that slept."""


class Watchdog:
    """Looks at the clock once a period; coming late itself, it has to let others speak first.

    After a freeze of the whole host the poses of the meantime wait in the queue. To hold still for
    want of them would stop a tip that nothing is wrong with.
    """

    def __init__(self, period: float) -> None:
        """Begins to watch.

        Args:
            period: time [s] between two looks.
        """
        self.period = period
        self._last = float('-inf')

    def slept(self, now: float) -> bool:
        """Whether a look at a time [s] comes more than a period late; the next one may not."""
        late = self._last > float('-inf') and now - self._last > 2.0 * self.period
        self._last = now
        return late
