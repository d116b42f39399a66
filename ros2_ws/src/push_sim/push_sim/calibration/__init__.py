"""Plant parameters fitted to measurements, and the parameter file made of them."""

from push_sim.calibration.as_json import calibration_json
from push_sim.calibration.as_table import calibration_table
from push_sim.calibration.fit import calibration
from push_sim.calibration.parameter_file import parameter_file

__all__ = ['calibration', 'calibration_json', 'calibration_table', 'parameter_file']
