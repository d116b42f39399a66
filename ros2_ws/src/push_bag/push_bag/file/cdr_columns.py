"""Decodes many messages of one type at once, field by field, into arrays.

CDR gives a field the same place in every message as long as the texts before it are equally long.
So messages are grouped by length, a group becomes a matrix of bytes, and a field is a slice of
columns; where a text's length differs, the group is split. This takes about a fiftieth of the time
of decoding message by message.
"""

from collections.abc import Collection, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from push_bag.file.cdr_layout import Leaf

Columns: TypeAlias = dict[str, NDArray[Any]]
Rows: TypeAlias = NDArray[np.intp]
_LITTLE_ENDIAN_CDR = (0, 1)
_HEADER = 4  # bytes before the first field; alignment counts from here


def columns(messages: Sequence[bytes], layout: Sequence[Leaf], wanted: Collection[str]) -> Columns:
    """Some fields of all messages.

    Args:
        messages: CDR with its 4-byte header, all of one type.
        layout: fields of the type, see `cdr_layout.leaves`.
        wanted: names of the fields to decode; none behind one without a fixed size.

    Returns:
        By name, (n,) or (n, count), or (n,) texts.

    Raises:
        ValueError: bytes that are not messages of this type.
    """
    last = max(index for index, leaf in enumerate(layout) if leaf.name in wanted)
    decoder = _Decoder(layout[: last + 1], wanted, len(messages))
    lengths = np.fromiter(map(len, messages), np.intp, len(messages))
    for length in np.unique(lengths):
        rows = np.flatnonzero(lengths == length)
        joined = b''.join(messages[row] for row in rows.tolist())
        decoder.group(np.frombuffer(joined, np.uint8).reshape(rows.size, int(length)), rows)
    return decoder.found


class _Decoder:
    """Fills the columns, group by group."""

    def __init__(self, layout: Sequence[Leaf], wanted: Collection[str], size: int) -> None:
        self._layout = layout
        self.found: Columns = {
            leaf.name: _empty(leaf, size) for leaf in layout if leaf.name in wanted
        }

    def group(self, matrix: NDArray[np.uint8], rows: Rows) -> None:
        """Decodes messages (n, length) of equal length into rows (n,)."""
        if matrix.shape[1] < _HEADER or np.any(matrix[:, :2] != _LITTLE_ENDIAN_CDR):
            raise ValueError('not little-endian CDR')
        self._from(0, matrix[:, _HEADER:], rows, 0)

    def _from(self, index: int, matrix: NDArray[np.uint8], rows: Rows, at: int) -> None:
        """Decodes all fields from one on, which begins at a byte or after padding."""
        for number in range(index, len(self._layout)):
            leaf = self._layout[number]
            if leaf.dtype == 'str':
                self._from_text(number, matrix, rows, at)
                return
            at = self._number(leaf, matrix, rows, at)

    def _number(self, leaf: Leaf, matrix: NDArray[np.uint8], rows: Rows, at: int) -> int:
        if not leaf.dtype:
            raise ValueError(f'{leaf.name} has no fixed size')
        size = np.dtype(leaf.dtype).itemsize
        at += -at % size
        values = _view(matrix, at, leaf.dtype, leaf.count)
        if leaf.name in self.found:
            self.found[leaf.name][rows] = values if leaf.count > 1 else values[:, 0]
        return at + size * leaf.count

    def _from_text(self, index: int, matrix: NDArray[np.uint8], rows: Rows, at: int) -> None:
        """Decodes a text and all behind it, for each length of the text by itself."""
        at += -at % 4
        lengths = _view(matrix, at, '<u4', 1)[:, 0]
        for length in np.unique(lengths):
            here = lengths == length
            begin, end = at + 4, at + 4 + int(length)
            if end > matrix.shape[1]:
                raise ValueError('a text is longer than its message')
            self._text(self._layout[index], matrix[here, begin:end], rows[here])
            self._from(index + 1, matrix[here], rows[here], end)

    def _text(self, leaf: Leaf, matrix: NDArray[np.uint8], rows: Rows) -> None:
        if leaf.name in self.found:
            texts = [bytes(row).rstrip(b'\0').decode('utf-8', 'replace') for row in matrix]
            self.found[leaf.name][rows] = texts


def _empty(leaf: Leaf, size: int) -> NDArray[Any]:
    if not leaf.dtype:
        raise ValueError(f'{leaf.name} has no fixed size')
    if leaf.dtype == 'str':
        return np.full(size, '', dtype=object)
    return np.zeros((size, leaf.count) if leaf.count > 1 else size, leaf.dtype)


def _view(matrix: NDArray[np.uint8], at: int, dtype: str, count: int) -> NDArray[Any]:
    """Numbers (n, count) that begin at a byte of each message."""
    end = at + np.dtype(dtype).itemsize * count
    if end > matrix.shape[1]:
        raise ValueError('a message is too short')
    return np.ascontiguousarray(matrix[:, at:end]).view(dtype)
