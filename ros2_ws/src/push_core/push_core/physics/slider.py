"""The pushed square and the round tip: geometry and friction."""

from dataclasses import dataclass

import numpy as np

from push_core.common import setting, validate
from push_core.geometry import Array, to_body, to_world

HIGHEST_FRICTION = 2.0
"""A tip that always sticks cannot tell it from a lower one."""


@dataclass(frozen=True)
class Slider:
    """Geometry and friction of the square and of the round tip that pushes its face x = -side/2.

    Friction and support radius are those of an ellipsoidal limit surface, an approximation: the
    radius that fits the measured pushes best is 29 mm for those with the least rotation, 39 mm for
    those with the most, and 34.8 mm for all. The default fits pushes that turn the square by less
    than 6.7 rad per metre, the curvature of the 8-track.
    """

    side: float = setting(0.09, 'side of the square', unit='m', low=0.01, high=1.0)
    mass: float = setting(0.827, 'mass of the square', unit='kg', low=0.01, high=100.0)
    friction_ground: float = setting(0.35, 'friction between square and table', low=0.01, high=2.0)
    friction_pusher: float = setting(
        0.3, 'friction between square and tip', low=0.0, high=HIGHEST_FRICTION
    )
    support_radius: float = setting(
        0.031, 'largest friction moment over largest friction force', unit='m', low=1e-3, high=1.0
    )
    tip_radius: float = setting(0.00475, 'radius of the round tip', unit='m', low=0.0, high=0.1)

    def __post_init__(self) -> None:
        validate(self)

    @property
    def p_x(self) -> float:
        """Body-frame x [m] of the pushed face."""
        return -self.side / 2.0

    @property
    def tip_x(self) -> float:
        """Body-frame x [m] of the tip's centre in contact."""
        return self.p_x - self.tip_radius

    def contact_offset(self, object_pose: Array, tip: Array) -> float:
        """Offset p_y [m] along the pushed face of a tip (2,) beside an object pose (3,)."""
        return float(to_body(object_pose, tip)[1])

    def gap(self, object_pose: Array, tip: Array) -> float:
        """Distance [m] between tip (2,) and the line of the pushed face; negative inside."""
        return self.tip_x - float(to_body(object_pose, tip)[0])

    def tip_position(self, object_pose: Array, p_y: float, gap: float = 0.0) -> Array:
        """World position (2,) of the tip at contact offset p_y [m] and a gap [m] off the face."""
        return to_world(object_pose, np.array([self.tip_x - gap, p_y]))
