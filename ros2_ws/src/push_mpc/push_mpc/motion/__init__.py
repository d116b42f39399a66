"""Equations of motion of the pushed object, and their Jacobians."""

from push_mpc.motion.contact_force import ContactForce
from push_mpc.motion.dynamics import Motion, TabulatedModel, TravelModel, TravelMotion
from push_mpc.motion.expansion import Expansion
from push_mpc.motion.travel_rates import travel_rates

__all__ = [
    'ContactForce',
    'Expansion',
    'Motion',
    'TabulatedModel',
    'TravelModel',
    'TravelMotion',
    'travel_rates',
]
