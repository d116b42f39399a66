"""What keeps a 10 ms loop in Python on time."""

import gc
import os
from pathlib import Path

_PRIORITY = 20


def _stop_collecting() -> None:
    """Ends the warm-up: no garbage collection from here on."""
    gc.collect()
    gc.freeze()
    gc.disable()


def _raise_priority() -> str:
    """Asks for a real-time priority for all threads of the process.

    For nodes that keep to the wall clock; at another pace it would starve those that do not.

    Returns:
        One line that says which scheduling the process got.
    """
    try:
        for thread in Path('/proc/self/task').iterdir():
            os.sched_setscheduler(int(thread.name), os.SCHED_FIFO, os.sched_param(_PRIORITY))
    except (OSError, AttributeError):
        return 'ordinary scheduling: a real-time priority is not permitted here'
    return f'real-time scheduling, SCHED_FIFO {_PRIORITY}'


def settled(mode: str) -> str:
    """Ends the warm-up of a node that runs in a mode, `realtime` or `lockstep`.

    Returns:
        One line that says which scheduling the process got.
    """
    _stop_collecting()
    return _raise_priority() if mode == 'realtime' else 'ordinary scheduling'
