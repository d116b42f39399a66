"""What several kinds of faults use: their type, and times after which a fault can be known."""

import random
from collections.abc import Callable

from push_bringup.faults.bed import Bed

Inject = Callable[[Bed, random.Random], float]
"""Puts a fault into a cell; returns how long it lasts [s]."""
WATCHDOG = 0.05  # [s], parameter command_timeout
RECORDER_SILENCE = 2.6  # [s] from the end of the recorder to the stop
FOR_GOOD = 3.0  # [s]
BOTH = ('realtime', 'lockstep')


def wait_out(bed: Bed, duration: float) -> None:
    """Waits a time [s] of the cell, or until its run ends."""
    begun = bed.now()
    bed.wait(lambda: bed.ended or bed.now() - begun > 1e9 * duration, 20.0)
