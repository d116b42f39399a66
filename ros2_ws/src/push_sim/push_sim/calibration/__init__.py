"""Calibration of the plant: parameters fitted to measurements, and their parameter file."""

from push_sim.calibration.calibration import calibrate_plant
from push_sim.calibration.output import calibration_json, calibration_table, ros_parameter_file

__all__ = ['calibrate_plant', 'calibration_json', 'calibration_table', 'ros_parameter_file']
