"""The physics engines behind one interface."""

from push_sim.worlds.engines import make_world
from push_sim.worlds.quick_world import SPEED, SUBSTEP, quick_world

__all__ = ['SPEED', 'SUBSTEP', 'make_world', 'quick_world']
