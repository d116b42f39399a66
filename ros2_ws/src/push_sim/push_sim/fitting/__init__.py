"""Least-squares fits of plant parameters to measurements."""

from push_sim.fitting.actuator_fit import fitted_actuator
from push_sim.fitting.world_fit import FITTED, Pushes, WorldFit, fitted_world

__all__ = ['FITTED', 'Pushes', 'WorldFit', 'fitted_actuator', 'fitted_world']
