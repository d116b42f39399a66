"""The index of a bag's chunks, on disk until the bag is finished."""

import tempfile
from collections.abc import Iterator
from pathlib import Path

from mcap.data_stream import ReadDataStream, RecordBuilder
from mcap.records import ChunkIndex


class ChunkIndexes:
    """Takes the place of the list in the library's writer, which would grow with the recording."""

    def __init__(self, folder: Path) -> None:
        """Opens a file without a name.

        Args:
            folder: on whose disk it lies.
        """
        self._file = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115  closed by `close`

    def append(self, index: ChunkIndex) -> None:
        """Adds the index of one chunk."""
        record = RecordBuilder()
        index.write(record)
        self._file.write(record.end())  # type: ignore[no-untyped-call]

    def __iter__(self) -> Iterator[ChunkIndex]:
        """All of them in order, one at a time in memory."""
        end = self._file.tell()
        self._file.seek(0)
        stream = ReadDataStream(self._file)
        while stream.count < end:
            stream.read1()
            stream.read8()
            yield ChunkIndex.read(stream)

    def close(self) -> None:
        """Removes the file."""
        self._file.close()
