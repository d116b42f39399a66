"""Conversion between finite displacements and constant twists.

A push that turns the object by theta moves it along an arc: the displacement is turned by
theta / 2 against the initial direction of motion. Both functions are exact to second order in
theta, which is 0.1 % at the 7 degrees of the largest measured 4 mm push.
"""

import numpy as np

from push_core.geometry.frames import Array


def twist_of(displacement: Array, jacobian: Array) -> tuple[Array, Array]:
    """The constant twist that gives displacements, times their duration.

    Args:
        displacement: (n, 3) [m, m, rad] in the body frame at the start.
        jacobian: its derivatives (n, 3, m) by anything.

    Returns:
        Twist (n, 3) and its derivatives (n, 3, m).
    """
    return _leaning(displacement, jacobian, 0.5)


def displacement_of(twist: Array, jacobian: Array) -> tuple[Array, Array]:
    """The displacement (n, 3) after a constant twist (n, 3), with derivatives (n, 3, m)."""
    return _leaning(twist, jacobian, -0.5)


def _leaning(motion: Array, jacobian: Array, share: float) -> tuple[Array, Array]:
    """Turns the translation clockwise by a share of the rotation."""
    x, y, turn = np.asarray(motion).T
    across = np.stack([y, -x, np.zeros_like(x)], axis=-1)
    by = np.asarray(jacobian)
    across_by = np.stack([by[:, 1], -by[:, 0], np.zeros_like(by[:, 0])], axis=1)
    moved = motion + share * turn[:, None] * across
    return moved, by + share * (
        across[:, :, None] * by[:, None, 2] + turn[:, None, None] * across_by
    )
