"""Parameters of the plant, and named profiles of them."""

from push_sim.settings.plant_settings import (
    ENGINE_NAMES,
    PERIOD,
    PerturbationKind,
    PerturbationSettings,
    SensorSettings,
    SimSettings,
    StartOffset,
    WorldSettings,
)
from push_sim.settings.profiles import PROFILES, profile

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
