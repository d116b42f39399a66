"""Decodes fields of many messages of one type into arrays.

In CDR a field has the same offset in every message in which the strings before it have the same
lengths. So messages of equal length form a matrix of bytes (n, length), and a field is a slice of
its columns; where a string's length differs, the matrix is split by rows. 18 to 77 times as fast
as deserializing message by message with rclpy.
"""

from collections.abc import Collection, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from push_bag.file.cdr_layout import Leaf

Columns: TypeAlias = dict[str, NDArray[Any]]
Rows: TypeAlias = NDArray[np.intp]
_LITTLE_ENDIAN_CDR = (0, 1)
_ZSTD = b'\x28\xb5\x2f\xfd'
COMPRESSED = (
    'its messages are compressed one by one, as by rosbag2 in compression mode "message"; '
    '`ros2 bag convert` writes them without'
)
_HEADER = 4  # bytes before the first field; alignment is relative to its end


def is_compressed(data: bytes) -> bool:
    """Whether a message is compressed by itself; CDR never begins so."""
    return data.startswith(_ZSTD)


def columns(messages: Sequence[bytes], layout: Sequence[Leaf], names: Collection[str]) -> Columns:
    """Decodes the named fields of all messages.

    Args:
        messages: n messages of one type: CDR with its 4-byte header.
        layout: fields of the type, see `cdr_layout.leaves`.
        names: fields to decode; none of them may follow a field without a fixed size.

    Returns:
        Arrays by name: numbers (n,) or (n, count), or strings (n,).

    Raises:
        ValueError: the bytes are not messages of this type.
    """
    last = max(index for index, leaf in enumerate(layout) if leaf.name in names)
    decoder = _Decoder(layout[: last + 1], names, len(messages))
    lengths = np.fromiter(map(len, messages), np.intp, len(messages))
    for length in np.unique(lengths):
        rows = np.flatnonzero(lengths == length)
        joined = b''.join(messages[row] for row in rows.tolist())
        decoder.add(np.frombuffer(joined, np.uint8).reshape(rows.size, int(length)), rows)
    return decoder.columns


class _Decoder:
    """Fills the columns."""

    def __init__(self, layout: Sequence[Leaf], names: Collection[str], size: int) -> None:
        self._layout = layout
        self.columns: Columns = {
            leaf.name: _empty(leaf, size) for leaf in layout if leaf.name in names
        }

    def add(self, matrix: NDArray[np.uint8], rows: Rows) -> None:
        """Decodes messages of equal length (n, length) into the rows (n,) of the columns."""
        if matrix.shape[1] >= _HEADER and is_compressed(matrix[0, :_HEADER].tobytes()):
            raise ValueError(COMPRESSED)
        if matrix.shape[1] < _HEADER or np.any(matrix[:, :2] != _LITTLE_ENDIAN_CDR):
            raise ValueError('not little-endian CDR')
        self._decode_from(0, matrix[:, _HEADER:], rows, 0)

    def _decode_from(self, index: int, matrix: NDArray[np.uint8], rows: Rows, at: int) -> None:
        """Decodes the fields from an index on; the first is at an offset, plus padding."""
        for number in range(index, len(self._layout)):
            leaf = self._layout[number]
            if leaf.dtype == 'str':
                self._decode_string_from(number, matrix, rows, at)
                return
            at = self._decode_number(leaf, matrix, rows, at)

    def _decode_number(self, leaf: Leaf, matrix: NDArray[np.uint8], rows: Rows, at: int) -> int:
        if not leaf.dtype:
            raise ValueError(f'{leaf.name} has no fixed size')
        size = np.dtype(leaf.dtype).itemsize
        at += -at % size
        values = _view(matrix, at, leaf.dtype, leaf.count)
        if leaf.name in self.columns:
            self.columns[leaf.name][rows] = values if leaf.count > 1 else values[:, 0]
        return at + size * leaf.count

    def _decode_string_from(
        self, index: int, matrix: NDArray[np.uint8], rows: Rows, at: int
    ) -> None:
        """Decodes a string and the fields after it, separately for each length of the string."""
        at += -at % 4
        lengths = _view(matrix, at, '<u4', 1)[:, 0]
        for length in np.unique(lengths):
            here = lengths == length
            begin, end = at + 4, at + 4 + int(length)
            if end > matrix.shape[1]:
                raise ValueError('a string is longer than its message')
            self._decode_text(self._layout[index], matrix[here, begin:end], rows[here])
            self._decode_from(index + 1, matrix[here], rows[here], end)

    def _decode_text(self, leaf: Leaf, matrix: NDArray[np.uint8], rows: Rows) -> None:
        if leaf.name in self.columns:
            texts = [bytes(row).rstrip(b'\0').decode('utf-8', 'replace') for row in matrix]
            self.columns[leaf.name][rows] = texts


def _empty(leaf: Leaf, size: int) -> NDArray[Any]:
    if not leaf.dtype:
        raise ValueError(f'{leaf.name} has no fixed size')
    if leaf.dtype == 'str':
        return np.full(size, '', dtype=object)
    return np.zeros((size, leaf.count) if leaf.count > 1 else size, leaf.dtype)


def _view(matrix: NDArray[np.uint8], at: int, dtype: str, count: int) -> NDArray[Any]:
    """Numbers (n, count) at an offset of each message."""
    end = at + np.dtype(dtype).itemsize * count
    if end > matrix.shape[1]:
        raise ValueError('a message is too short')
    return np.ascontiguousarray(matrix[:, at:end]).view(dtype)
