"""Settings of the plant, and the profiles that bundle them."""

from push_sim.settings.plant_settings import (
    ENGINES,
    PERIOD,
    PROFILES,
    PerturbationSettings,
    SensorSettings,
    SimSettings,
    WorldSettings,
    profile,
)

__all__ = [
    'ENGINES',
    'PERIOD',
    'PROFILES',
    'PerturbationSettings',
    'SensorSettings',
    'SimSettings',
    'WorldSettings',
    'profile',
]
