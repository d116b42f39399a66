"""The CSV form of a push set: one row a push, SI units; the only definition of its columns."""

import csv
import io
import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from push_core.atomic_file import write_atomically
from push_core.errors import InputError
from push_core.frames import Array
from push_core.push_set import PushSet, check_distance, push_fault

COLUMNS = ('p_y_m', 'beta_rad', 'dx_m', 'dy_m', 'dtheta_rad', 'distance_m')
"""Columns of every file; columns `subset_...` of 0 and 1 may follow."""

SUBSET_PREFIX = 'subset_'


def read_pushes(path: Path) -> PushSet:
    """Reads a push set.

    Args:
        path: a CSV file with the columns `COLUMNS` in any order.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    header, *rows = list(_lines(path)) or [(0, [])]
    names = _checked_names(path, header[1])
    if not rows:
        raise InputError(f'{path}: holds no pushes')
    table = np.array([_numbers(path, line, names, cells) for line, cells in rows])
    lines = [line for line, _ in rows]
    return _push_set(path, lines, dict(zip(names, table.T, strict=True)))


def write_pushes(path: Path, pushes: PushSet) -> None:
    """Writes a push set so that reading it gives the same numbers; whole or not at all.

    Raises:
        InputError: the file cannot be written.
    """
    write_atomically(path, _as_text(pushes).encode())


def _as_text(pushes: PushSet) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator='\n')
    writer.writerow((*COLUMNS, *pushes.subsets))
    members = [member.astype(int).tolist() for member in pushes.subsets.values()]
    numbers = np.column_stack(
        (pushes.inputs, pushes.displacement, np.full(len(pushes), pushes.distance))
    )
    for row, *member in zip(numbers.tolist(), *members, strict=True):
        writer.writerow((*row, *member))
    return text.getvalue()


def _lines(path: Path) -> Iterator[tuple[int, list[str]]]:
    try:
        with path.open(encoding='utf-8-sig', newline='') as file:
            reader = csv.reader(file)
            yield from ((reader.line_num, cells) for cells in reader if cells)
    except OSError as error:
        raise InputError(f'cannot read {path}: {error.strerror}') from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(f'{path}: is not a CSV text file ({error})') from error


def _checked_names(path: Path, names: Sequence[str]) -> list[str]:
    names = [name.strip() for name in names]
    if not names:
        raise InputError(f'{path}: is empty')
    missing = [name for name in COLUMNS if name not in names]
    if missing:
        raise InputError(
            f'{path}, line 1: column {", ".join(missing)} is missing; '
            f'a push set has the columns {",".join(COLUMNS)}'
        )
    for name in names:
        if name not in COLUMNS and not name.startswith(SUBSET_PREFIX):
            raise InputError(f'{path}, line 1: unknown column {name!r}')
        if names.count(name) > 1:
            raise InputError(f'{path}, line 1: column {name} is there twice')
    return names


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


def _push_set(path: Path, lines: Sequence[int], column: dict[str, Array]) -> PushSet:
    p_y, beta, dx, dy, dtheta, distance = (column[name] for name in COLUMNS)
    displacement = np.column_stack((dx, dy, dtheta))
    fault = push_fault(p_y, beta, displacement)
    if fault:
        raise InputError(f'{path}, line {lines[fault[0]]}: {fault[1]}')
    _check_distances(path, lines, distance)
    subsets = {
        name: _membership(path, lines, name, values)
        for name, values in column.items()
        if name.startswith(SUBSET_PREFIX)
    }
    return PushSet(p_y, beta, displacement, float(distance[0]), subsets)


def _check_distances(path: Path, lines: Sequence[int], distance: Array) -> None:
    try:
        check_distance(float(distance[0]))
    except InputError as error:
        raise InputError(f'{path}, line {lines[0]}: {error}') from None
    other = np.flatnonzero(distance != distance[0])
    if other.size:
        raise InputError(
            f'{path}, line {lines[other[0]]}: distance_m is {distance[other[0]]:g}, '
            f'but {distance[0]:g} above; one set holds pushes of one distance'
        )


def _membership(path: Path, lines: Sequence[int], name: str, values: Array) -> NDArray[np.bool_]:
    wrong = np.flatnonzero((values != 0) & (values != 1))
    if wrong.size:
        raise InputError(
            f'{path}, line {lines[wrong[0]]}: {name} is {values[wrong[0]]:g}, must be 0 or 1'
        )
    return values.astype(np.bool_)
