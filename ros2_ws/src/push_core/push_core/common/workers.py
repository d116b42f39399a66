"""Work in several processes, its results in the order of the tasks."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any, TypeAlias

Map: TypeAlias = Callable[[Callable[..., Any], Iterable[tuple[Any, ...]]], Iterator[Any]]
"""Takes a function and its arguments for each task; yields the results in order."""


def usable_cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0))


@contextmanager
def workers(jobs: int) -> Iterator[Map]:
    """A map over `jobs` processes; they end with the block, however it is left."""
    if jobs == 1:
        yield _in_turn
        return
    # a forked physics server would be shared
    context = multiprocessing.get_context('spawn')
    with _deaf_to_interrupts():
        pool = context.Pool(jobs)
    with pool:
        yield lambda function, tasks: pool.imap(_Spread(function), tasks)


class _Spread:
    """A function of one task, for a pool."""

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function

    def __call__(self, task: tuple[Any, ...]) -> Any:
        return self._function(*task)


def _in_turn(function: Callable[..., Any], tasks: Iterable[tuple[Any, ...]]) -> Iterator[Any]:
    return (function(*task) for task in tasks)


@contextmanager
def _deaf_to_interrupts() -> Iterator[None]:
    """Processes started in here leave Ctrl-C to the one that started them."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
