"""Planar geometry: frames, quaternions, displacements and twists."""

from push_core.geometry.displacement import displacement_of, twist_of
from push_core.geometry.frames import Array, rotation, to_body, to_world, wrap_angle
from push_core.geometry.quaternion import grid_yaw, quaternion_to_yaw, yaw_to_quaternion

__all__ = [
    'Array',
    'displacement_of',
    'grid_yaw',
    'quaternion_to_yaw',
    'rotation',
    'to_body',
    'to_world',
    'twist_of',
    'wrap_angle',
    'yaw_to_quaternion',
]
