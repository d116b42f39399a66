"""Named sets of plant settings. A new profile is one entry here and one in `ACTUATORS`."""

import math
from collections.abc import Mapping

from push_core.common import InputError
from push_core.physics import ACTUATORS

from push_sim.settings.plant_settings import SensorSettings, SimSettings
from push_sim.settings.world_settings import WorldSettings

PROFILES: Mapping[str, SimSettings] = {
    'irb120': SimSettings(actuator=ACTUATORS['irb120']),
    'ideal': SimSettings(
        actuator=ACTUATORS['ideal'],
        sensor=SensorSettings(position_noise=0.0, angle_noise=0.0, latency=0.0),
    ),
    'harsh': SimSettings(
        actuator=ACTUATORS['harsh'],
        world=WorldSettings(friction_variation=0.1, friction_anisotropy=1.1, mass_error=0.1),
        sensor=SensorSettings(
            position_noise=0.3e-3,
            angle_noise=math.radians(0.1),
            latency=0.01,
            jitter=0.005,
            dropout=0.02,
            freeze_rate=0.1,
        ),
        command_loss=0.01,
    ),
    'webcam': SimSettings(
        actuator=ACTUATORS['webcam'],
        sensor=SensorSettings(
            position_noise=1e-3,
            angle_noise=math.radians(1.0),
            rate=30.0,
            latency=0.03,
            jitter=0.02,
            dropout=0.02,
        ),
    ),
}


def profile(name: str) -> SimSettings:
    """The settings of a named profile.

    Raises:
        InputError: there is no such profile.
    """
    if name not in PROFILES:
        raise InputError(f'parameter profile is {name!r}, must be one of {", ".join(PROFILES)}')
    return PROFILES[name]
