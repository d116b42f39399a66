"""A pool of worker processes."""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias

Map: TypeAlias = Callable[[Callable[..., Any], Iterable[tuple[Any, ...]]], Iterator[Any]]
"""Takes a function and a tuple of arguments for each task; yields the results."""


@dataclass(frozen=True)
class Workers:
    """Ways to run many tasks.

    Attributes:
        in_order: yields the results in the order of the tasks.
        as_done: yields each result as soon as it is there.
    """

    in_order: Map
    as_done: Map


def usable_cores() -> int:
    """Number of cores that this process may use."""
    return len(os.sched_getaffinity(0))


@contextmanager
def worker_pool(jobs: int) -> Iterator[Workers]:
    """Starts `jobs` processes and ends them with the block; one job runs in this process."""
    if jobs == 1:
        yield Workers(_in_this_process, _in_this_process)
        return
    # spawn: a forked process would share the physics server
    context = multiprocessing.get_context('spawn')
    with _interrupts_ignored():
        pool = context.Pool(jobs)
    with pool:
        yield Workers(
            lambda function, tasks: pool.imap(partial(_call, function), tasks),
            lambda function, tasks: pool.imap_unordered(partial(_call, function), tasks),
        )


def _call(function: Callable[..., Any], task: tuple[Any, ...]) -> Any:
    return function(*task)


def _in_this_process(
    function: Callable[..., Any], tasks: Iterable[tuple[Any, ...]]
) -> Iterator[Any]:
    return (function(*task) for task in tasks)


@contextmanager
def _interrupts_ignored() -> Iterator[None]:
    """Processes started in this block ignore Ctrl-C: the parent ends them."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
