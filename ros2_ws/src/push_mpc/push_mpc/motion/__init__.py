"""Equations of motion of the pushed object, and their Jacobians."""

from push_mpc.motion.contact_force import ContactForce
from push_mpc.motion.dynamics import Motion, TravelModel, TravelMotion, discretised
from push_mpc.motion.travel_rates import travel_rates

__all__ = ['ContactForce', 'Motion', 'TravelModel', 'TravelMotion', 'discretised', 'travel_rates']
