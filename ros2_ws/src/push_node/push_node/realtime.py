"""Garbage collection, scheduling, core and memory of a process with a 10 ms loop."""

import contextlib
import ctypes
import gc
import os
import resource
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from push_core.common import RealtimeSettings

# from sys/mman.h: pages are locked when they are first used, so that reserved ones cost nothing
_MCL_CURRENT, _MCL_FUTURE, _MCL_ONFAULT = 1, 2, 4


@dataclass(frozen=True)
class Scheduling:
    """What a process got.

    Attributes:
        text: how it is scheduled, in one line.
        warning: what was refused, with the reasons, in one line; empty if nothing was.
    """

    text: str
    warning: str = ''


def enter_realtime(mode: str, wanted: RealtimeSettings) -> Scheduling:
    """Switches garbage collection off and asks the kernel; call it after the warm-up.

    Args:
        mode: `realtime` or `lockstep`. In lockstep nothing is asked: the priority would starve
            the other nodes.
        wanted: priority, core and memory.
    """
    gc.collect()
    gc.freeze()
    gc.disable()
    if mode != 'realtime':
        return Scheduling('ordinary scheduling')
    got, refused = [], []
    for text, ask in _requests(wanted):
        try:
            ask()
        except (OSError, AttributeError) as error:
            refused.append(f'{text} ({getattr(error, "strerror", None) or "not on this system"})')
        else:
            got.append(text)
    warning = f'not permitted here: {", ".join(refused)}; see docs/operating.md' if refused else ''
    return Scheduling(', '.join(got) or 'ordinary scheduling', warning)


def leave_realtime() -> None:
    """Gives a helper process back what it inherited: ordinary scheduling on any core."""
    os.sched_setscheduler(0, os.SCHED_OTHER, os.sched_param(0))
    os.sched_setaffinity(0, range(os.cpu_count() or 1))


def schedule_alone(priority: int) -> None:
    """Schedules all threads that there are, and no process that they start.

    What the kernel refuses is left as it is.

    Args:
        priority: of SCHED_FIFO; 0 for ordinary scheduling.
    """
    policy = os.SCHED_FIFO | os.SCHED_RESET_ON_FORK if priority else os.SCHED_OTHER
    with contextlib.suppress(OSError):
        _set_priority(priority, policy)


def _requests(wanted: RealtimeSettings) -> Iterator[tuple[str, Callable[[], None]]]:
    if wanted.priority:
        yield f'SCHED_FIFO {wanted.priority}', lambda: _set_priority(wanted.priority)
    if wanted.cpu >= 0:
        yield f'core {wanted.cpu}', lambda: _set_core(wanted.cpu)
    if wanted.lock_memory:
        yield 'locked memory', _lock_memory


def _threads() -> list[int]:
    return [int(thread.name) for thread in Path('/proc/self/task').iterdir()]


def _set_priority(priority: int, policy: int = os.SCHED_FIFO) -> None:
    for thread in _threads():
        os.sched_setscheduler(thread, policy, os.sched_param(priority))


def _set_core(core: int) -> None:
    for thread in _threads():
        os.sched_setaffinity(thread, {core})


def _lock_memory() -> None:
    # with a finite limit a later allocation would fail in the middle of a run
    limit, _ = resource.getrlimit(resource.RLIMIT_MEMLOCK)
    if limit != resource.RLIM_INFINITY and os.geteuid() != 0:
        raise OSError(0, f'the limit is {limit // 1024} KiB, must be unlimited')
    library = ctypes.CDLL(None, use_errno=True)
    if library.mlockall(_MCL_CURRENT | _MCL_FUTURE | _MCL_ONFAULT) != 0:
        number = ctypes.get_errno()
        raise OSError(number, os.strerror(number))
