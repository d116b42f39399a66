"""Which face of the square is pushed, and on which half: pushes that differ in this are alike.

A solver that iterates until an error is small treats faces and halves alike only up to that error.
Seen from the pushed face, on the half that is pushed, they are one and the same push.
"""

import math
from typing import NamedTuple

from push_core.physics import Pair

from push_sim.worlds.common import Axes

_NOTHING = 1e-9


class Symmetry(NamedTuple):
    """How a push is seen.

    Attributes:
        turn: heading [rad] of the pushed face, as of the face x = -side/2, against the square's.
        side: -1 where the push is seen in a mirror.
    """

    turn: float
    side: float


PLAIN = Symmetry(0.0, 1.0)


def symmetry(pose: tuple[float, float, float], tip: Pair, velocity: Pair) -> Symmetry:
    """How to see the push of a square at a pose by a tip [m] with a velocity [m/s]."""
    x, y = Axes(*pose).point_inside(tip)
    turn = 0.5 * math.pi * round(math.atan2(-y, -x) / (0.5 * math.pi))
    face = Axes(pose[0], pose[1], pose[2] + turn)
    offset, across = face.point_inside(tip)[1], face.vector_inside(velocity)[1]
    aside = offset if abs(offset) > _NOTHING else across
    return Symmetry(turn, -1.0 if aside < -_NOTHING else 1.0)
