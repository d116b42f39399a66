"""One cell at a time in a ROS domain and namespace: two would command the same pusher."""

import fcntl
import os
import tempfile
from pathlib import Path
from typing import IO

from push_core.common import RunError


class CellLock:
    """Locks the name of a cell; the kernel releases the lock when the process ends."""

    def __init__(self, namespace: str) -> None:
        domain = os.environ.get('ROS_DOMAIN_ID', '0') or '0'
        name = f'push_cell_{os.getuid()}_{domain}_{namespace or "root"}.lock'
        self._path = Path(tempfile.gettempdir()) / name.replace('/', '.')
        self._file: IO[str] | None = None

    def __enter__(self) -> 'CellLock':
        self._file = self._path.open('a', encoding='utf-8')
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self._file.close()
            raise RunError(
                'another cell runs here; give this one a --namespace or a ROS_DOMAIN_ID of its own'
            ) from None
        return self

    def __exit__(self, *_error: object) -> None:
        if self._file is not None:
            self._file.close()
