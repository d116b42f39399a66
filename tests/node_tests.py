"""What tests that start nodes need: a DDS domain of their own, an end of processes."""

import fcntl
import itertools
import os
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import IO

import pytest

_users = int(os.environ.get('ROS_DOMAIN_ID') or 0)  # where a cell may run that is none of a test
_NUMBERS = [number for number in range(1, 233) if number != _users]
_begin = 13 * os.getpid() % len(_NUMBERS)
_next = itertools.cycle(_NUMBERS[_begin:] + _NUMBERS[:_begin])
# nodes of a test may stay in a domain as long as the process, whose end releases the locks
_held: list[IO[str]] = []


def own_domain() -> str:
    """A domain of this process until it ends; no other test of this user gets the same."""
    for number in itertools.islice(_next, len(_NUMBERS)):
        name = f'push_cell_test_{os.getuid()}_{number}.lock'
        lock = (Path(tempfile.gettempdir()) / name).open('a', encoding='utf-8')
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            lock.close()
            continue
        _held.append(lock)
        return str(number)
    raise RuntimeError('other tests that run on this machine have taken all DDS domains')


def starts_nodes(request: pytest.FixtureRequest) -> bool:
    """Whether a test of the requesting file is marked as one that starts nodes."""
    tests = [item for item in request.session.items if item.path == request.path]
    return any(test.get_closest_marker('processes') for test in tests)


def kill_all(processes: Iterable[subprocess.Popen[str]]) -> None:
    """Ends the processes that a test has started, and reads what is left of their output."""
    for process in processes:
        if process.poll() is None:
            process.kill()
        process.communicate()
