"""A recorded run of the real robot: commanded and reported tip, and the object's pose."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from push_core.common import InputError
from push_core.data.csv_table import CsvTable, read_table
from push_core.geometry import Array

COLUMNS = (
    *('t_s', 'slider_x_m', 'slider_y_m', 'slider_theta_rad'),
    *('pusher_cmd_x_m', 'pusher_cmd_y_m', 'pusher_x_m', 'pusher_y_m'),
)
_SHORTEST = 1.0  # [s]
_LONGEST_GAP = 0.2  # [s] between two rows
_AT_REST = 1e-4  # [m] of the tip's last position
_FARTHEST = 10.0  # [m] from the origin; a file in millimetres lies beyond


@dataclass(frozen=True)
class RobotRun:
    """One run of n rows at about 500 Hz, world frame.

    Attributes:
        name: of the file.
        time: (n,) since the first row [s], increasing.
        pose: (n, 3) x [m], y [m], theta [rad, continuous] of the object.
        commanded: (n, 2) commanded position of the tip [m].
        tip: (n, 2) position of the tip that the robot reported [m].
    """

    name: str
    time: Array
    pose: Array
    commanded: Array
    tip: Array

    @property
    def following(self) -> int:
        """Number of rows until the tip stops for good.

        One measured robot stopped by itself while its commands went on: the rows after its tip's
        last 0.1 mm say nothing about how the tip follows the commands.
        """
        moves = np.linalg.norm(self.tip - self.tip[-1], axis=1) > _AT_REST
        return int(np.flatnonzero(moves)[-1]) + 1


def read_robot_run(path: Path) -> RobotRun:
    """Reads a CSV file with the columns `COLUMNS` in any order.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    table = read_table(path, 'rows', COLUMNS)
    _check_rows(table)
    rows = np.column_stack([table.columns[name] for name in COLUMNS])
    rows[:, 3] = np.unwrap(rows[:, 3])
    time = rows[:, 0] - rows[0, 0]
    run = RobotRun(path.name, time, rows[:, 1:4], rows[:, 4:6], rows[:, 6:8])
    _check_length(path, run)
    return run


def _check_rows(table: CsvTable) -> None:
    steps = np.diff(table.columns['t_s'], prepend=-np.inf)
    lengths = np.abs([table.columns[name] for name in COLUMNS if name.endswith('_m')])
    for wrong, text in (
        (steps <= 0.0, 't_s does not rise'),
        ((steps > _LONGEST_GAP) & np.isfinite(steps), f'more than {_LONGEST_GAP:g} s are missing'),
        (
            (lengths > _FARTHEST).any(axis=0),
            f'a position is beyond {_FARTHEST:g} m; metres are expected',
        ),
        (
            np.abs(table.columns['slider_theta_rad']) > math.tau,
            'slider_theta_rad is beyond 2 pi; radians are expected',
        ),
    ):
        if wrong.any():
            raise InputError(f'{table.place(int(np.argmax(wrong)))}: {text}')


def _check_length(path: Path, run: RobotRun) -> None:
    if run.time[-1] < _SHORTEST:
        raise InputError(f'{path}: the run lasts less than {_SHORTEST:g} s')
    if (np.linalg.norm(run.tip - run.tip[-1], axis=1) <= _AT_REST).all():
        raise InputError(f'{path}: the tip does not move in the whole run')
