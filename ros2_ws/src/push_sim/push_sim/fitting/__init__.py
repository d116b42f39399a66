"""Least-squares fits of plant parameters to measurements."""

from push_sim.fitting.actuator_fit import fit_actuator
from push_sim.fitting.world_fit import FITTED, PushesToFit, WorldFit, fit_world

__all__ = ['FITTED', 'PushesToFit', 'WorldFit', 'fit_actuator', 'fit_world']
