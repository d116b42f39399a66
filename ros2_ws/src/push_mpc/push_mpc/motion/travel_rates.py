"""Converts displacements after a push, as models predict them, to twists per metre of travel."""

import numpy as np
from push_core.geometry import Array, twist_of


def travel_rates(mean: Array, jacobian: Array, distance: float) -> tuple[Array, Array]:
    """Twist per metre of travel.

    Args:
        mean: displacements (n, 3) [m, m, rad] after a push, in the frame at its start.
        jacobian: their derivatives (n, 3, 2) by [p_y, beta].
        distance: travel of the pusher in the push [m].

    Returns:
        Rates (n, 3) [1, 1, rad/m] and their derivatives (n, 3, 2).
    """
    twist, by = twist_of(mean, jacobian)
    return np.asarray(twist / distance), np.asarray(by / distance)
