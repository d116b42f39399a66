"""Writes a bag completely or not at all, for bags that can be written again from their source."""

import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from push_core.common import RunError

from push_bag.file.bag_writer import BagWriter


@contextmanager
def atomic_bag(
    folder: Path,
    facts: Mapping[str, str],
    attachments: Mapping[str, bytes],
    profile: str = 'ros2',
) -> Iterator[BagWriter]:
    """A `BagWriter` with the same arguments, whose new folder is removed if an error is raised.

    Raises:
        InputError: the folder exists already or cannot be created.
        RunError: the bag cannot be written.
    """
    was_there = folder.exists()
    try:
        with BagWriter(folder, facts, attachments, profile) as writer:
            yield writer
    except BaseException as error:
        if not was_there:
            shutil.rmtree(folder, ignore_errors=True)
        if isinstance(error, RunError) and isinstance(error.__cause__, OSError):
            raise RunError(f'cannot write {folder}: {error.__cause__.strerror}') from error
        raise
