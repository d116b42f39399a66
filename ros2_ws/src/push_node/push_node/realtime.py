"""Garbage collection and scheduling of a process with a 10 ms loop."""

import gc
import os
from pathlib import Path

_PRIORITY = 20


def _raise_priority() -> str:
    """Requests real-time priority for all threads of the process; returns the result in words."""
    try:
        for thread in Path('/proc/self/task').iterdir():
            os.sched_setscheduler(int(thread.name), os.SCHED_FIFO, os.sched_param(_PRIORITY))
    except (OSError, AttributeError):
        return 'ordinary scheduling: a real-time priority is not permitted here'
    return f'real-time scheduling, SCHED_FIFO {_PRIORITY}'


def enter_realtime(mode: str) -> str:
    """Switches garbage collection off and requests real-time priority; call it after the warm-up.

    Args:
        mode: `realtime` or `lockstep`. In lockstep the priority stays ordinary: it would starve
            the other nodes.

    Returns:
        The scheduling that the process got, in one line.
    """
    gc.collect()
    gc.freeze()
    gc.disable()
    return _raise_priority() if mode == 'realtime' else 'ordinary scheduling'
