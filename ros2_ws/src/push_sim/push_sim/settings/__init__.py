"""Parameters of the plant, and named profiles of them."""

from push_sim.settings.plant_settings import (
    PerturbationKind,
    PerturbationSettings,
    SensorSettings,
    SimSettings,
    StartOffset,
)
from push_sim.settings.profiles import PROFILES, profile
from push_sim.settings.world_settings import ENGINE_NAMES, PERIOD, WorldSettings

__all__ = [
    'ENGINE_NAMES',
    'PERIOD',
    'PROFILES',
    'PerturbationKind',
    'PerturbationSettings',
    'SensorSettings',
    'SimSettings',
    'StartOffset',
    'WorldSettings',
    'profile',
]
