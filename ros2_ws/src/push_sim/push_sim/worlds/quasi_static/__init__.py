"""The quasi-static engine: integrated motion cone of an ellipsoidal limit surface."""

from push_sim.worlds.quasi_static.quasi_static_world import QuasiStaticWorld

__all__ = ['QuasiStaticWorld']
