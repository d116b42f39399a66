"""A measured run of the real cell: what was commanded, what the tip did, what the object did."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from push_core.common import InputError
from push_core.data import CsvTable, read_table
from push_core.geometry import Array

COLUMNS = (
    *('t_s', 'slider_x_m', 'slider_y_m', 'slider_theta_rad'),
    *('pusher_cmd_x_m', 'pusher_cmd_y_m', 'pusher_x_m', 'pusher_y_m'),
)
_SHORTEST = 1.0
_WIDEST_GAP = 0.2
_AT_REST = 1e-4


@dataclass(frozen=True)
class RobotRun:
    """One run, n rows of about 500 Hz.

    Attributes:
        name: of the file that it came from.
        time: (n,) since the first row [s], rising.
        object_pose: (n, 3) x [m], y [m], theta [rad] of the object, theta without jumps.
        commanded: (n, 2) position of the tip that was asked for [m].
        sensed: (n, 2) position of the tip that the robot reported [m].
    """

    name: str
    time: Array
    object_pose: Array
    commanded: Array
    sensed: Array

    @property
    def following(self) -> int:
        """Rows in which the tip followed its commands.

        One measured robot stopped by itself while its commands went on: the rows after the tip's
        last 0.1 mm tell nothing about how it follows.
        """
        left = np.linalg.norm(self.sensed - self.sensed[-1], axis=1) > _AT_REST
        return int(np.flatnonzero(left)[-1]) + 1


def read_robot_run(path: Path) -> RobotRun:
    """Reads a run with the columns `COLUMNS`.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    table = read_table(path, 'rows', COLUMNS)
    _check(table)
    pose = _stacked(table, 'slider_x_m', 'slider_y_m', 'slider_theta_rad')
    pose[:, 2] = np.unwrap(pose[:, 2])
    return RobotRun(
        path.name,
        table.columns['t_s'] - table.columns['t_s'][0],
        pose,
        _stacked(table, 'pusher_cmd_x_m', 'pusher_cmd_y_m'),
        _stacked(table, 'pusher_x_m', 'pusher_y_m'),
    )


def _stacked(table: CsvTable, *names: str) -> Array:
    return np.column_stack([table.columns[name] for name in names])


def _check(table: CsvTable) -> None:
    steps = np.diff(table.columns['t_s'], prepend=-np.inf)
    lengths = np.abs(_stacked(table, *(name for name in COLUMNS if name.endswith('_m'))))
    for wrong, text in (
        (steps <= 0.0, 't_s does not rise'),
        ((steps > _WIDEST_GAP) & np.isfinite(steps), f'more than {_WIDEST_GAP:g} s are missing'),
        ((lengths > 10.0).any(axis=1), 'a position is beyond 10 m; metres are expected'),
        (
            np.abs(table.columns['slider_theta_rad']) > math.tau,
            'slider_theta_rad is beyond 2 pi; radians are expected',
        ),
    ):
        if wrong.any():
            raise InputError(f'{table.place(int(np.argmax(wrong)))}: {text}')
    _check_length(table)


def _check_length(table: CsvTable) -> None:
    time, tip = table.columns['t_s'], _stacked(table, 'pusher_x_m', 'pusher_y_m')
    if time[-1] - time[0] < _SHORTEST:
        raise InputError(f'{table.path}: the run lasts less than {_SHORTEST:g} s')
    if (np.linalg.norm(tip - tip[-1], axis=1) <= _AT_REST).all():
        raise InputError(f'{table.path}: the tip does not move in the whole run')
