"""Mechanics of pushing: slider, limit surface, contact, motion cone, actuator, speed limits."""

from push_core.physics.actuator import ACTUATORS, Actuator, ActuatorSettings, Pair
from push_core.physics.inertia import INERTIA_FROM, slider_at_speed, with_inertia
from push_core.physics.limit_surface import GRAVITY, LimitSurface, uniform_pressure_radius
from push_core.physics.motion_cone import GRAZING, ContactMode, MotionCone, contact_jacobian
from push_core.physics.point_contact import (
    mobility,
    sliding_force,
    slip_sign,
    sticking_force,
    twist_of_force,
)
from push_core.physics.safety import LIMIT_NAMES, NOT_FINITE, SafetyLimits, limit, slowed
from push_core.physics.slider import HIGHEST_FRICTION, Slider

__all__ = [
    'ACTUATORS',
    'GRAVITY',
    'GRAZING',
    'HIGHEST_FRICTION',
    'INERTIA_FROM',
    'LIMIT_NAMES',
    'NOT_FINITE',
    'Actuator',
    'ActuatorSettings',
    'ContactMode',
    'LimitSurface',
    'MotionCone',
    'Pair',
    'SafetyLimits',
    'Slider',
    'contact_jacobian',
    'limit',
    'mobility',
    'slider_at_speed',
    'sliding_force',
    'slip_sign',
    'slowed',
    'sticking_force',
    'twist_of_force',
    'uniform_pressure_radius',
    'with_inertia',
]
