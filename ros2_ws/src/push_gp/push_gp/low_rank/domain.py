"""Where pushes lie, and so where a model is asked: the face with a margin, directions into it."""

import math

import numpy as np
from push_core.data import P_Y_LIMIT
from push_core.geometry import Array

from push_gp.low_rank.chebyshev import Interval

CENTRE = np.array([0.0, math.pi / 2.0])
COVERED = np.array([P_Y_LIMIT, math.pi / 2.0]) * 1.001
"""Pushes lie within centre +- this [m, rad], and so does what the controller asks."""

INTERVALS = tuple(Interval(*each) for each in zip(CENTRE.tolist(), COVERED.tolist(), strict=True))


def covers(queries: Array) -> bool:
    """Whether (m, 2) queries all lie within."""
    return bool((np.abs(queries - CENTRE) <= COVERED).all())
