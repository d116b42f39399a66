"""Settings of the plant, and the profiles that bundle them."""

from push_sim.settings.plant_settings import (
    ENGINE_NAMES,
    PERIOD,
    PerturbationSettings,
    SensorSettings,
    SimSettings,
    WorldSettings,
)
from push_sim.settings.profiles import PROFILES, profile

__all__ = [
    'ENGINE_NAMES',
    'PERIOD',
    'PROFILES',
    'PerturbationSettings',
    'SensorSettings',
    'SimSettings',
    'WorldSettings',
    'profile',
]
