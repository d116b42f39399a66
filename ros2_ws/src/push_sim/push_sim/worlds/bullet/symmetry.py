"""Mirrors every push to one canonical face and half, so that the engine is exactly symmetric.

An iterative solver treats faces and halves alike only up to its residual. Turned to the face
x = -side/2 and mirrored to its upper half, symmetric pushes are numerically the same push.
"""

import math
from typing import NamedTuple

from push_core.physics import Pair

from push_sim.worlds.common import Axes, Pose

_TOLERANCE = 1e-9


class Symmetry(NamedTuple):
    """The map of a push to the canonical face and half.

    Attributes:
        turn: angle [rad] from the face x = -side/2 to the pushed face, in the object's frame.
        side: -1 if the push is mirrored, else 1.
    """

    turn: float
    side: float

    @classmethod
    def of_push(cls, pose: Pose, tip: Pair, velocity: Pair) -> 'Symmetry':
        """The map for a square at a pose and a tip at a position [m] with a velocity [m/s]."""
        x, y = Axes(*pose).point_from_world(tip)
        turn = 0.5 * math.pi * round(math.atan2(-y, -x) / (0.5 * math.pi))
        face = Axes(pose[0], pose[1], pose[2] + turn)
        offset, across = face.point_from_world(tip)[1], face.vector_from_world(velocity)[1]
        decisive = offset if abs(offset) > _TOLERANCE else across
        return cls(turn, -1.0 if decisive < -_TOLERANCE else 1.0)


IDENTITY = Symmetry(0.0, 1.0)
