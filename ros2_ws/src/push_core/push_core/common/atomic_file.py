"""Files that are written completely or not at all."""

import contextlib
import os
import tempfile
from pathlib import Path

from push_core.common.errors import InputError


def check_place(path: Path) -> None:
    """Checks that a file can be written, before the work for it begins.

    Raises:
        InputError: its folder does not exist or is not writable, or it is not a regular file.
    """
    if path.is_dir():
        raise InputError(f'cannot write {path}: it is a folder')
    if path.exists() and not path.is_file():
        raise InputError(f'cannot write {path}: it is a device or a pipe, not a file')
    folder = path.resolve().parent
    if not folder.is_dir():
        raise InputError(f'cannot write {path}: there is no folder {path.parent}')
    try:
        # permission bits are not enough: not even root may write everywhere
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise InputError(f'cannot write {path}: {error.strerror}') from error


def write_atomically(path: Path, content: bytes) -> None:
    """Writes a file under a temporary name and renames it; a reader never sees half of it.

    Args:
        path: of the file; an existing one is replaced, a link followed.
        content: of the file.

    Raises:
        InputError: see `check_place`; or the disk is full.
    """
    check_place(path)
    try:
        _write_and_move(path.resolve(), content)
    except OSError as error:
        raise InputError(f'cannot write {path}: {error.strerror}') from error


def _write_and_move(path: Path, content: bytes) -> None:
    descriptor, name = tempfile.mkstemp(dir=path.parent, prefix=f'.{path.name}.')
    try:
        with os.fdopen(descriptor, 'wb') as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        # mkstemp makes private files; use the permissions of other new files
        Path(name).chmod(0o666 & ~_umask())
        Path(name).replace(path)
    except BaseException:
        with contextlib.suppress(OSError):
            Path(name).unlink()
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
