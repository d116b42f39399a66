"""The physics engines behind one interface."""

from push_sim.worlds.engines import COARSE_SUBSTEP, ENGINES, make_coarse_world, make_world

__all__ = ['COARSE_SUBSTEP', 'ENGINES', 'make_coarse_world', 'make_world']
