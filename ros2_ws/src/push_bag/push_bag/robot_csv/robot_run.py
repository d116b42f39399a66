"""A measured run of the real cell, as its CSV file tells it."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from push_core.common import InputError
from push_core.data import read_table

from push_bag.run import Floats

COLUMNS = (
    *('t_s', 'slider_x_m', 'slider_y_m', 'slider_theta_rad'),
    *('pusher_cmd_x_m', 'pusher_cmd_y_m', 'pusher_x_m', 'pusher_y_m'),
)
SLOPE_TIME = 0.01  # [s] over which a slope is taken: the rows come unevenly


@dataclass(frozen=True)
class RobotRun:
    """One run, n rows.

    Attributes:
        name: of the file.
        time: (n,) since the first row [s], rising.
        pose: (n, 3) of the object [m, m, rad].
        commanded: (n, 2) position of the tip that was asked for [m].
        tip: (n, 2) position of the tip that the robot reported [m].
    """

    name: str
    time: Floats
    pose: Floats
    commanded: Floats
    tip: Floats

    @property
    def velocity(self) -> Floats:
        """Commanded velocity (n, 2) [m/s]."""
        half = 0.5 * SLOPE_TIME
        ahead, behind = (
            np.stack([np.interp(time, self.time, each) for each in self.commanded.T], axis=1)
            for time in (self.time + half, self.time - half)
        )
        return np.asarray((ahead - behind) / SLOPE_TIME)

    @property
    def progress(self) -> Floats:
        """How far along the x axis (n,) [m] the object has come; it never goes back."""
        return np.asarray(np.maximum.accumulate(self.pose[:, 0]))


def read_robot_run(path: Path) -> RobotRun:
    """Reads a run with the columns COLUMNS.

    Raises:
        InputError: one line that names the file and the fault.
    """
    table = read_table(path, 'rows', COLUMNS)
    rows = np.column_stack([table.columns[name] for name in COLUMNS])
    if len(rows) < 2 or not (np.diff(rows[:, 0]) > 0.0).all():
        raise InputError(f'{path}: t_s must rise from row to row')
    return RobotRun(path.stem, rows[:, 0] - rows[0, 0], rows[:, 1:4], rows[:, 4:6], rows[:, 6:8])
