"""Picks the cheaper of two ways to the same mean and Jacobian."""

from collections.abc import Sequence

from push_core.frames import Array

from push_gp.batched_mean import BatchedMean
from push_gp.domain import covers
from push_gp.feature_mean import FeatureMean
from push_gp.folded_process import Process

WORTH_FOLDING = 250
"""Pushes from which the fixed cost of the features is less than that of all covariances."""

PER_FEATURE = 5
"""The same for each feature of an input, where short lengthscales need many."""


class PosteriorMean:
    """Over the pushes themselves where they are few, else over features they were folded into."""

    def __init__(self, processes: Sequence[Process]) -> None:
        """Prepares both for processes that share their inputs."""
        self._over_pushes = BatchedMean(processes)
        least = max(WORTH_FOLDING, PER_FEATURE * FeatureMean.size(processes))
        many = len(processes[0].outputs) >= least
        folds = many and FeatureMean.suits(processes)
        self._over_features = FeatureMean(processes) if folds else None

    def evaluate(self, queries: Array) -> tuple[Array, Array]:
        """Mean (m, k) and Jacobian (m, k, 2) at (m, 2) queries."""
        if self._over_features is not None and covers(queries):
            return self._over_features.evaluate(queries)
        return self._over_pushes.evaluate(queries)
