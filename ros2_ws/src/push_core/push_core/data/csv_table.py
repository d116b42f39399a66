"""Tables of numbers as CSV: a line of column names, then rows; every fault names its line."""

import csv
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from push_core.common import InputError
from push_core.geometry import Array


@dataclass(frozen=True)
class CsvTable:
    """A table of finite numbers.

    Attributes:
        path: where it came from.
        lines: line number of each row in the file.
        columns: name to values (n,), n >= 1.
    """

    path: Path
    lines: Sequence[int]
    columns: Mapping[str, Array]

    def place(self, row: int) -> str:
        """How a message names a row."""
        return f'{self.path}, line {self.lines[row]}'


def column_names(path: Path) -> tuple[str, ...]:
    """The names of the first line; none where the file is empty.

    Raises:
        InputError: the file cannot be read.
    """
    _, names = next(_lines(path), (0, []))
    return tuple(name.strip() for name in names)


def read_table(
    path: Path, content: str, wanted: Sequence[str], prefix: str | None = None
) -> CsvTable:
    """Reads a table.

    Args:
        path: a CSV file with the wanted columns in any order.
        content: what a row is, in the plural, for the messages.
        wanted: columns that must be there.
        prefix: of names of further columns that may be there; none without it.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    header, *rows = list(_lines(path)) or [(0, [])]
    names = [name.strip() for name in header[1]]
    _check_names(path, names, wanted, prefix)
    if not rows:
        raise InputError(f'{path}: holds no {content}')
    numbers = np.array([_numbers(path, line, names, cells) for line, cells in rows])
    lines = [line for line, _ in rows]
    return CsvTable(path, lines, dict(zip(names, numbers.T, strict=True)))


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    try:
        with path.open(encoding='utf-8-sig', newline='') as file:
            reader = csv.reader(file)
            yield from ((reader.line_num, cells) for cells in reader if cells)
    except OSError as error:
        raise InputError(f'cannot read {path}: {error.strerror}') from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f'{path}: is not a CSV text file ({error})') from error


def _check_names(
    path: Path, names: Sequence[str], wanted: Sequence[str], prefix: str | None
) -> None:
    if not names:
        raise InputError(f'{path}: is empty')
    missing = [name for name in wanted if name not in names]
    if missing:
        raise InputError(
            f'{path}, line 1: column {", ".join(missing)} is missing; '
            f'the columns are {",".join(wanted)}'
        )
    for name in names:
        if name not in wanted and not (prefix and name.startswith(prefix)):
            raise InputError(f'{path}, line 1: unknown column {name[:40]!r}')
        if names.count(name) > 1:
            raise InputError(f'{path}, line 1: column {name[:40]} is there twice')


def _numbers(path: Path, line: int, names: Sequence[str], cells: Sequence[str]) -> list[float]:
    if len(cells) != len(names):
        raise InputError(f'{path}, line {line}: has {len(cells)} values, not {len(names)}')
    return [
        _number(f'{path}, line {line}: {name}', cell)
        for name, cell in zip(names, cells, strict=True)
    ]


def _number(place: str, cell: str) -> float:
    try:
        number = float(cell)
    except ValueError:
        raise InputError(f'{place} is {cell[:40]!r}, not a number') from None
    if not math.isfinite(number):
        raise InputError(f'{place} is {cell.strip()}, not a finite number')
    return number
