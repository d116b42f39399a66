"""Planar geometry: frames, quaternions, displacements and twists."""

from push_core.geometry.displacement import displacement_of, twist_of
from push_core.geometry.frames import (
    Array,
    points_to_body,
    rotation,
    to_body,
    to_world,
    wrap_angle,
    wrap_angles,
)
from push_core.geometry.quaternion import grid_yaw, quaternion_to_yaw, yaw_to_quaternion

__all__ = [
    'Array',
    'displacement_of',
    'grid_yaw',
    'points_to_body',
    'quaternion_to_yaw',
    'rotation',
    'to_body',
    'to_world',
    'twist_of',
    'wrap_angle',
    'wrap_angles',
    'yaw_to_quaternion',
]
