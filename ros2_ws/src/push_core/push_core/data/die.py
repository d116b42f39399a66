"""The five of a die: the smallest set of pushes from which the paper's controller learned.

One push at the middle of the face along its normal, and four half-way to its ends, 30 degrees to
either side. Source: Bauza, Hogan and Rodriguez 2018, section 6 (five hand-picked points).
"""

import math

import numpy as np

from push_core.geometry import Array

_PLACES = np.array([[0.0, 0.0], [-0.5, -30.0], [0.5, -30.0], [-0.5, 30.0], [0.5, 30.0]])


def five_of_a_die(half_face: float) -> Array:
    """The five places (5, 2): contact offset p_y [m] and direction beta [rad].

    Args:
        half_face: half the length of the pushed face [m].
    """
    return np.asarray(_PLACES * [half_face, math.radians(1.0)] + [0.0, math.pi / 2.0])
