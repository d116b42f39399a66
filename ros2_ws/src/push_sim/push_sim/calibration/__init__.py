"""Calibration of the plant: parameters fitted to measurements, and their parameter file."""

from push_sim.calibration.calibration import FittedParameter, calibrate_plant
from push_sim.calibration.output import calibration_json, calibration_table, ros_parameter_file
from push_sim.calibration.recording import (
    calibrate_recorded,
    is_bag,
    read_recording,
    recorded_table,
)

__all__ = [
    'FittedParameter',
    'calibrate_plant',
    'calibrate_recorded',
    'calibration_json',
    'calibration_table',
    'is_bag',
    'read_recording',
    'recorded_table',
    'ros_parameter_file',
]
