"""CSV files of long pushes: object pose and tip before and after, world frame, SI units."""

from pathlib import Path

import numpy as np

from push_core.common import InputError
from push_core.data.csv_table import CsvTable, column_names, read_table
from push_core.data.long_pushes import LongPushes
from push_core.geometry import Array
from push_core.physics import Slider

COLUMNS = (
    *('x0_m', 'y0_m', 'theta0_rad', 'x1_m', 'y1_m', 'theta1_rad'),
    *('tip_x0_m', 'tip_y0_m', 'tip_x1_m', 'tip_y1_m'),
)
"""Object and tip before (0) and after (1) the push, in any order."""

FARTHEST = 10.0
"""[m], [rad]; a file in millimetres or degrees lies beyond."""

TOUCHING = 0.01
"""Largest distance [m] between tip and face at the start."""


def holds_long_pushes(path: Path) -> bool:
    """Whether a file names the columns of long pushes.

    Raises:
        InputError: it cannot be read.
    """
    return set(COLUMNS) <= set(column_names(path, COLUMNS))


def read_long_pushes(path: Path, slider: Slider | None = None) -> LongPushes:
    """Reads long pushes.

    Args:
        path: a CSV file with the columns `COLUMNS` in any order.
        slider: the square and the tip; default: the measured ones.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    slider = slider or Slider()
    table = read_table(path, 'pushes', COLUMNS)
    numbers = np.column_stack([table.columns[name] for name in COLUMNS])
    _check_range(table, numbers)
    pushes = LongPushes.on_any_face(
        slider, numbers[:, :3], numbers[:, 3:6], numbers[:, 6:8], numbers[:, 8:]
    )
    _check_contact(table, pushes)
    return pushes


def _check_range(table: CsvTable, numbers: Array) -> None:
    rows, columns = np.nonzero(np.abs(numbers) > FARTHEST)
    if rows.size:
        raise InputError(
            f'{table.place(rows[0])}: {COLUMNS[columns[0]]} is '
            f'{numbers[rows[0], columns[0]]:g}; metres and radians are expected'
        )


def _check_contact(table: CsvTable, pushes: LongPushes) -> None:
    for row, (pose, tip) in enumerate(zip(pushes.start, pushes.tip_start, strict=True)):
        gap = pushes.slider.gap(pose, tip)
        beside = abs(pushes.slider.contact_offset(pose, tip)) - pushes.slider.side / 2.0
        if max(abs(gap), beside) > TOUCHING:
            raise InputError(
                f'{table.place(row)}: the tip starts {1e3 * max(abs(gap), beside):.1f} mm away '
                'from the face'
            )
