"""Least-squares fits of plant parameters to measurements."""

from push_sim.fitting.actuator_fit import ActuatorFit, fit_actuator, fit_recorded
from push_sim.fitting.world_fit import FITTED, PushesToFit, WorldFit, fit_world

__all__ = [
    'FITTED',
    'ActuatorFit',
    'PushesToFit',
    'WorldFit',
    'fit_actuator',
    'fit_recorded',
    'fit_world',
]
