"""Bytes of a file at any offset, with bounded memory."""

from collections.abc import Iterator
from pathlib import Path
from types import TracebackType

WINDOW = 1 << 20  # [B] read at once


class ByteFile:
    """A file that is open for reading; keeps one window of it in memory.

    A memory map would be shorter, but its pages count as memory of the process.

    Attributes:
        path: of the file.
        size: of the file when it was opened [B].
    """

    def __init__(self, path: Path) -> None:
        """Opens the file.

        Raises:
            OSError: the file cannot be read.
        """
        self.path = path
        self.size = path.stat().st_size
        self._stream = path.open('rb', buffering=0)
        self._window = b''
        self._begin = 0

    def __enter__(self) -> 'ByteFile':
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._stream.close()

    def read(self, at: int, count: int) -> bytes:
        """Bytes from an offset on; fewer than `count` at the end of the file."""
        begin = at - self._begin
        if begin >= 0 and begin + count <= len(self._window):
            return self._window[begin : begin + count]
        if count > WINDOW:
            return self._from_disk(at, count)
        self._window, self._begin = self._from_disk(at, WINDOW), at
        return self._window[:count]

    def blocks(self, begin: int, end: int) -> Iterator[bytes]:
        """The bytes between two offsets in pieces of at most WINDOW."""
        for at in range(begin, end, WINDOW):
            yield self._from_disk(at, min(WINDOW, end - at))

    def find(self, wanted: bytes, begin: int, end: int) -> int:
        """Offset of the first byte that is `wanted` in a range; -1 without one."""
        at = begin
        while at < min(end, self.size):
            if not self._begin <= at < self._begin + len(self._window):
                self._window, self._begin = self._from_disk(at, WINDOW), at
            found = self._window.find(wanted, at - self._begin, end - self._begin)
            if found >= 0:
                return self._begin + found
            at = self._begin + len(self._window)
        return -1

    def _from_disk(self, at: int, count: int) -> bytes:
        self._stream.seek(at)
        parts, left = [], min(count, max(self.size - at, 0))
        while left and (part := self._stream.read(left)):
            parts.append(part)
            left -= len(part)
        return b''.join(parts)
