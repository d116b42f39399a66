"""CSV files of push sets: one row per push, SI units."""

import csv
import io
import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from push_core.common import InputError, write_atomically
from push_core.data.csv_table import CsvTable, read_table
from push_core.data.push_set import PushSet, check_distance, push_fault
from push_core.geometry import Array

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
    return _push_set(read_table(path, 'pushes', COLUMNS, SUBSET_PREFIX))


def write_pushes(path: Path, pushes: PushSet) -> None:
    """Writes a push set atomically; reading it gives the same numbers bit for bit.

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


def _push_set(table: CsvTable) -> PushSet:
    p_y, beta, dx, dy, dtheta, distance = (table.columns[name] for name in COLUMNS)
    displacement = np.column_stack((dx, dy, dtheta))
    fault = push_fault(p_y, beta, displacement)
    if fault:
        raise InputError(f'{table.place(fault[0])}: {fault[1]}{_hint(table)}')
    _check_distances(table, distance)
    subsets = {
        name: _membership(table, name) for name in table.columns if name.startswith(SUBSET_PREFIX)
    }
    return PushSet(p_y, beta, displacement, float(distance[0]), subsets)


def _hint(table: CsvTable) -> str:
    """The unit or convention that values outside their domain suggest, empty without one."""
    largest = {name: float(np.abs(table.columns[name]).max()) for name in COLUMNS}
    beta = table.columns['beta_rad']
    hints = (
        (0.5 < largest['p_y_m'] <= 5.0, 'p_y_m looks like centimetres: divide by 100'),
        (5.0 < largest['p_y_m'] < 100.0, 'p_y_m looks like millimetres: divide by 1000'),
        (math.tau < largest['beta_rad'] < 361.0, 'beta_rad looks like degrees: divide by 57.3'),
        (
            beta.min() < 0.0 and largest['beta_rad'] <= 0.5 * math.pi,
            'beta_rad looks measured from the inward normal: beta_rad = pi/2 - angle',
        ),
        (
            1.0 < max(largest['dx_m'], largest['dy_m']) < 1000.0,
            'dx_m and dy_m look like millimetres: divide by 1000',
        ),
        (
            math.pi < largest['dtheta_rad'] < 361.0,
            'dtheta_rad looks like degrees: divide by 57.3',
        ),
        (
            1.0 <= largest['distance_m'] < 1000.0,
            'distance_m looks like millimetres: divide by 1000',
        ),
    )
    return next((f'; {text}' for holds, text in hints if holds), '')


def _check_distances(table: CsvTable, distance: Array) -> None:
    try:
        check_distance(float(distance[0]))
    except InputError as error:
        raise InputError(f'{table.place(0)}: {error}{_hint(table)}') from None
    other = np.flatnonzero(distance != distance[0])
    if other.size:
        raise InputError(
            f'{table.place(other[0])}: distance_m is {distance[other[0]]:g}, '
            f'but {distance[0]:g} above; one set holds pushes of one distance'
        )


def _membership(table: CsvTable, name: str) -> NDArray[np.bool_]:
    values = table.columns[name]
    wrong = np.flatnonzero((values != 0) & (values != 1))
    if wrong.size:
        row = wrong[0]
        raise InputError(f'{table.place(row)}: {name} is {values[row]:g}, must be 0 or 1')
    return values.astype(np.bool_)
