"""Picks the cheaper of two ways to the same mean and Jacobian."""

from collections.abc import Sequence

from push_core.frames import Array

from push_gp.batched_mean import BatchedMean
from push_gp.domain import covers
from push_gp.folded_process import Process
from push_gp.polynomial_mean import PolynomialMean

POLYNOMIALS_PER_PUSH = 25
"""What costs as much as the covariances with one push."""


class PosteriorMean:
    """Over the pushes themselves where they are few, else over polynomials that sum them up."""

    def __init__(self, processes: Sequence[Process]) -> None:
        """Prepares both for processes that share their inputs."""
        self._over_pushes = BatchedMean(processes)
        polynomials = PolynomialMean(processes)
        most = POLYNOMIALS_PER_PUSH * len(processes[0].outputs)
        self._summed_up = polynomials if polynomials.size <= most else None

    def evaluate(self, queries: Array) -> tuple[Array, Array]:
        """Mean (m, k) and Jacobian (m, k, 2) at (m, 2) queries."""
        if self._summed_up is not None and covers(queries):
            return self._summed_up.evaluate(queries)
        return self._over_pushes.evaluate(queries)
