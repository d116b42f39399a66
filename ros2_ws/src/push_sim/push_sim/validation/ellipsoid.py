"""The ellipsoidal limit surface beside which the simulator is judged."""

from push_sim.settings import WorldSettings

ELLIPSOID = WorldSettings(engine='quasi_static', friction_pusher=0.229, support_radius=0.0348)
"""The motion cone, integrated, with the two numbers that fit the measured 4 mm pushes best."""
