"""Rows that a robot's log lacks."""

import numpy as np
from numpy.typing import NDArray

from push_bag.run import Floats

ON_GRID = 0.1  # of the median step: how far a step may be from a multiple of it in an even log
EVEN = 0.99  # share of such steps in an even log
LONG = 5.0  # median steps; in an uneven log a longer step is a gap


def lost_rows(time: Floats) -> NDArray[np.int64]:
    """Number of rows (n,) that are missing before each row.

    In an even log each step tells how many are missing; in one whose rows come unevenly only long
    steps do.

    Args:
        time: (n,) of the rows [s], increasing.
    """
    steps = np.diff(time)
    ratio = steps / np.median(steps)
    whole = np.maximum(np.rint(ratio), 1.0)
    even = np.mean(np.abs(ratio - whole) <= ON_GRID) >= EVEN
    missing = np.where((ratio > LONG) | even, whole - 1.0, 0.0)
    return np.concatenate([[0], missing.astype(np.int64)])
