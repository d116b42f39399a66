"""Data sets of pushes and their CSV files, and the prediction error on them."""

from push_core.data.checked_pushes import FORCE_HELP, checked_pushes, read_checked_pushes
from push_core.data.commanded_tip import CommandedTip
from push_core.data.csv_table import CsvTable, column_names, read_table
from push_core.data.long_push_csv import holds_long_pushes, read_long_pushes
from push_core.data.long_pushes import FACE_MARGIN, EndErrors, LongPushes
from push_core.data.prediction_accuracy import (
    OUTPUTS,
    READABLE,
    Accuracy,
    accuracy,
    in_push_frame,
    per_output,
)
from push_core.data.push_csv import read_pushes, write_pushes
from push_core.data.push_set import (
    HALF_FACE,
    P_Y_LIMIT,
    PushSet,
    check_distance,
    five_push_pattern,
    input_fault,
)
from push_core.data.robot_run import RobotRun, read_robot_run

__all__ = [
    'FACE_MARGIN',
    'FORCE_HELP',
    'HALF_FACE',
    'OUTPUTS',
    'P_Y_LIMIT',
    'READABLE',
    'Accuracy',
    'CommandedTip',
    'CsvTable',
    'EndErrors',
    'LongPushes',
    'PushSet',
    'RobotRun',
    'accuracy',
    'check_distance',
    'checked_pushes',
    'column_names',
    'five_push_pattern',
    'holds_long_pushes',
    'in_push_frame',
    'input_fault',
    'per_output',
    'read_checked_pushes',
    'read_long_pushes',
    'read_pushes',
    'read_robot_run',
    'read_table',
    'write_pushes',
]
