"""Whether the controller knows how well it predicts the next pose.

An innovation is a measured pose less its prediction from the pose before. The filter states a
standard deviation for each; if the two agree, 1.96 of them hold 95 % of the innovations. The
number of them that really held 95 % is the conformal factor (split conformal prediction, Vovk et
al. 2005): a bound of so many stated deviations holds the next pose of such a run with that
probability, whatever the distribution.
"""

import math
from typing import Any

import numpy as np

from push_bag.run import RunSeries

COVERED = 0.95
NORMAL = 1.96
"""Standard deviations on either side of the mean that hold 95 % of a normal distribution."""

COORDINATES = {'x': 'x', 'y': 'y', 'heading': 'theta'}


def prediction(run: RunSeries) -> dict[str, Any] | None:
    """Coverage of the predicted poses during tracking; None without a stated deviation."""
    ratios = {name: _ratios(run, column) for name, column in COORDINATES.items()}
    count = min(each.size for each in ratios.values())
    # fewer poses than that allow no bound of 95 %
    if count < math.ceil(1.0 / (1.0 - COVERED)):
        return None
    return {
        'poses': count,
        'coverage_95': {name: float(np.mean(each <= NORMAL)) for name, each in ratios.items()},
        'deviations_95': {name: _conformal(each) for name, each in ratios.items()},
    }


def _ratios(run: RunSeries, column: str) -> np.ndarray:
    """Sizes (n,) of the innovations during tracking in stated standard deviations."""
    deviation = run.state(f'innovation_deviation_{column}')
    innovation = run.state(f'innovation_{column}')
    known = run.following & np.isfinite(innovation) & (deviation > 0.0)
    return np.asarray(np.abs(innovation[known]) / deviation[known])


def _conformal(ratios: np.ndarray) -> float:
    """The smallest of the ratios (n,) that a further one exceeds with 5 % probability at most."""
    rank = math.ceil((ratios.size + 1) * COVERED)
    return float(np.sort(ratios)[min(rank, ratios.size) - 1])
