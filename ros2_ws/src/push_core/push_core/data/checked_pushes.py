"""Reading of pushes that somebody else measured: copies are left out, contradictions refused."""

import sys
from collections.abc import Callable
from pathlib import Path

from push_core.data.plausibility import check_plausible
from push_core.data.push_csv import read_pushes
from push_core.data.push_set import PushSet

FORCE_HELP = 'accept pushes that contradict the physics of pushing'


def to_stderr(text: str) -> None:
    """Prints a warning as one line."""
    sys.stderr.write(f'warning: {text}\n')


def read_checked_pushes(
    path: Path, *, force: bool = False, warn: Callable[[str], None] = to_stderr
) -> PushSet:
    """Reads a push set, counts exact copies once, and checks it against the physics of pushing.

    Args:
        path: a CSV file, see `read_pushes`.
        force: whether to accept a set that contradicts physics, with a warning.
        warn: called with each warning.

    Raises:
        InputError: one line that names the file and the fault.
    """
    return checked_pushes(read_pushes(path), str(path), force=force, warn=warn)


def checked_pushes(
    pushes: PushSet, place: str, *, force: bool = False, warn: Callable[[str], None] = to_stderr
) -> PushSet:
    """The set without exact copies, checked against the physics of pushing.

    Args:
        pushes: the set.
        place: where it comes from, for the messages.
        force: whether to accept a set that contradicts physics, with a warning.
        warn: called with each warning.

    Raises:
        InputError: the set contradicts physics.
    """
    distinct = pushes.without_copies()
    copies = len(pushes) - len(distinct)
    if copies:
        warn(f'{place}: {copies} of {len(pushes)} rows are copies of others and are left out')
    for text in check_plausible(distinct, place, force=force):
        warn(text)
    return distinct
