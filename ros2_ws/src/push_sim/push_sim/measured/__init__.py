"""Measured pushes and robot runs, and their replay in a simulated world."""

from push_sim.measured.measured_data import (
    MeasuredData,
    read_measured_data,
    split_measurements,
)
from push_sim.measured.measurement_files import COLUMNS, measurement_files
from push_sim.measured.replay import ProgressBar, Replay
from push_sim.measured.run_windows import Windows, cut_windows
from push_sim.measured.tip_replay import (
    modelled_tip,
    recorded_tip_error,
    rms_coordinate,
    tip_error,
)

__all__ = [
    'COLUMNS',
    'MeasuredData',
    'ProgressBar',
    'Replay',
    'Windows',
    'cut_windows',
    'measurement_files',
    'modelled_tip',
    'read_measured_data',
    'recorded_tip_error',
    'rms_coordinate',
    'split_measurements',
    'tip_error',
]
