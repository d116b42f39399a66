"""A bar on standard error, where somebody watches it."""

import sys
import time
from collections.abc import Iterable, Iterator
from typing import TypeVar

T = TypeVar('T')
_WIDTH = 30
_PAUSE = 0.1


def with_progress(items: Iterable[T], total: int, title: str) -> Iterator[T]:
    """Hands the items on and draws how many of the total have passed."""
    if not sys.stderr.isatty():
        yield from items
        return
    drawn = 0.0
    for done, item in enumerate(items, start=1):
        yield item
        if done == total or time.monotonic() - drawn > _PAUSE:
            drawn = time.monotonic()
            sys.stderr.write(bar(title, done, total))
    sys.stderr.write('\n')


def bar(title: str, done: int, total: int) -> str:
    """One line that overwrites itself: title, bar and count."""
    filled = _WIDTH * done // total
    return f'\r{title} [{"#" * filled}{" " * (_WIDTH - filled)}] {done}/{total}'
