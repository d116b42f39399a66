"""Measured pushes and robot runs, and their repetition in a world."""

from push_sim.measured.measured_data import (
    LONG_FILES,
    RUN_FILES,
    SHORT_FILES,
    MeasuredData,
    files_hash,
    read_measured_data,
)
from push_sim.measured.replay import Bar, Replay
from push_sim.measured.robot_run import RobotRun
from push_sim.measured.run_windows import Windows, windows
from push_sim.measured.split import split
from push_sim.measured.tip_replay import commanded_tip, rms_coordinate, tip_gap

__all__ = [
    'LONG_FILES',
    'RUN_FILES',
    'SHORT_FILES',
    'Bar',
    'MeasuredData',
    'Replay',
    'RobotRun',
    'Windows',
    'commanded_tip',
    'files_hash',
    'read_measured_data',
    'rms_coordinate',
    'split',
    'tip_gap',
    'windows',
]
