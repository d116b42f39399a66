"""Tables of numbers as CSV: a line of column names, then rows; every fault names its line."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from push_core.common import CsvText, InputError, number_of, read_csv_text
from push_core.geometry import Array


@dataclass(frozen=True)
class CsvTable:
    """A table of finite numbers.

    Attributes:
        path: of the file.
        lines: line number of each row in the file.
        columns: name to values (n,), n >= 1.
    """

    path: Path
    lines: Sequence[int]
    columns: Mapping[str, Array]

    def place(self, row: int) -> str:
        """How a message names a row."""
        return f'{self.path}, line {self.lines[row]}'


def column_names(path: Path, known: Sequence[str]) -> tuple[str, ...]:
    """The names of the columns, in lower case; none where the file has no line of names.

    Raises:
        InputError: the file cannot be read.
    """
    return tuple(read_csv_text(path, known).names)


def read_table(
    path: Path, content: str, columns: Sequence[str], prefix: str | None = None
) -> CsvTable:
    """Reads a table.

    Args:
        path: a CSV file with these columns in any order; others are ignored.
        content: what a row is, in the plural, for the messages.
        columns: that must be there.
        prefix: of names of further columns that are read where they are there.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    text = read_csv_text(path, columns)
    places = _places(text, columns, prefix)
    if not text.rows:
        raise InputError(f'{path}: holds no {content}')
    numbers = np.array([_numbers(text, line, cells, places) for line, cells in text.rows])
    lines = [line for line, _ in text.rows]
    return CsvTable(path, lines, dict(zip(places, numbers.T, strict=True)))


def _places(text: CsvText, columns: Sequence[str], prefix: str | None) -> dict[str, int]:
    """Where each column is that is to be read."""
    if not text.names and not text.rows:
        raise InputError(f'{text.path}: is empty')
    where = f'{text.path}, line {text.names_line}'
    if not text.names:
        raise InputError(f'{where}: names no columns; the first line must be {",".join(columns)}')
    missing = [name for name in columns if name not in text.names]
    if missing:
        raise InputError(
            f'{where}: column {", ".join(missing)} is missing; the columns are {",".join(columns)}'
        )
    read = [name for name in text.names if name in columns or (prefix and name.startswith(prefix))]
    for name in read:
        if text.names.count(name) > 1:
            raise InputError(f'{where}: column {name[:40]} is there twice')
    return {name: text.names.index(name) for name in read}


def _numbers(
    text: CsvText, line: int, cells: Sequence[str], places: Mapping[str, int]
) -> list[float]:
    count = len(text.names)
    # a separator at the end of a line makes one more cell, which is empty
    if len(cells) < count or any(cells[count:]):
        raise InputError(f'{text.path}, line {line}: has {len(cells)} values, not {count}')
    return [
        _number(f'{text.path}, line {line}: {name}', cells[place])
        for name, place in places.items()
    ]


def _number(place: str, cell: str) -> float:
    try:
        number = number_of(cell)
    except ValueError:
        raise InputError(f'{place} is {cell[:40]!r}, not a number') from None
    if not math.isfinite(number):
        raise InputError(f'{place} is {cell.strip()}, not a finite number')
    return number
