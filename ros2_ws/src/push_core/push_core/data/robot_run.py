"""A recorded run of the real robot: commanded and reported tip, and the object's pose."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from push_core.data.csv_table import read_table
from push_core.data.robot_run_checks import AT_REST, check_rows, check_run
from push_core.geometry import Array

COLUMNS = (
    *('t_s', 'slider_x_m', 'slider_y_m', 'slider_theta_rad'),
    *('pusher_cmd_x_m', 'pusher_cmd_y_m', 'pusher_x_m', 'pusher_y_m'),
)


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
        moves = np.linalg.norm(self.tip - self.tip[-1], axis=1) > AT_REST
        return int(np.flatnonzero(moves)[-1]) + 1


def read_robot_run(path: Path) -> RobotRun:
    """Reads a CSV file with the columns `COLUMNS` in any order.

    Raises:
        InputError: one line that names the file, the line and the fault.
    """
    table = read_table(path, 'rows', COLUMNS)
    check_rows(table)
    rows = np.column_stack([table.columns[name] for name in COLUMNS])
    rows[:, 3] = np.unwrap(rows[:, 3])
    time = rows[:, 0] - rows[0, 0]
    run = RobotRun(path.name, time, rows[:, 1:4], rows[:, 4:6], rows[:, 6:8])
    check_run(str(path), run.time, run.pose, run.tip)
    return run
