"""The last digits of a minimum, where a search by values stops at half of them."""

from collections.abc import Callable

import numpy as np
from push_core.frames import Array

DIFFERENCE = 1e-4
STEPS = 6
FARTHEST = 0.05
"""Largest change of an argument in all: this finishes a search, it does not begin one."""


def stationary_point(
    gradient: Callable[[Array], Array], start: Array, low: Array, high: Array
) -> Array:
    """Where the gradient vanishes near a minimum found roughly.

    Newton's method with the Hessian of the start, so that the end depends on the function alone
    and not on the path of the search. What lies on a bound stays there.

    Args:
        gradient: of a function of (k,) arguments.
        start: (k,) near the minimum.
        low: (k,) bounds.
        high: (k,) bounds.

    Returns:
        The point, or the start where there is no minimum nearby.
    """
    free = np.flatnonzero((start > low) & (start < high))
    slope = gradient(start)[free]
    hessian = _hessian(gradient, start, free)
    point = start.copy()
    for _ in range(STEPS):
        if not free.size or np.linalg.eigvalsh(hessian).min() <= 0.0:
            return start
        point[free] -= np.linalg.solve(hessian, slope)
        if (np.abs(point - start) > FARTHEST).any() or (point < low).any() or (point > high).any():
            return start
        slope = gradient(point)[free]
    return point


def _hessian(gradient: Callable[[Array], Array], at: Array, free: Array) -> Array:
    steps = DIFFERENCE * np.eye(len(at))[free]
    columns = [(gradient(at + step) - gradient(at - step))[free] for step in steps]
    hessian = np.stack(columns, axis=-1) / (2.0 * DIFFERENCE)
    return np.asarray(0.5 * (hessian + hessian.T))
