"""Picks the cheaper of two ways to the same mean and Jacobian."""

from collections.abc import Sequence

from push_core.geometry import Array

from push_gp.low_rank import Process, covers
from push_gp.models.batched_mean import BatchedMean
from push_gp.models.mean_function import MeanFunction
from push_gp.models.polynomial_mean import summed_up
from push_gp.models.polynomials import Polynomials, added

POLYNOMIALS_PER_PUSH = 25
"""What costs as much as the covariances with one push."""


class PosteriorMean:
    """Over the pushes themselves where they are few, else over polynomials that sum them up."""

    def __init__(self, processes: Sequence[Process], mean_function: MeanFunction) -> None:
        """Prepares both for processes that share their inputs, over what was expected before."""
        self._mean_function = mean_function
        self._over_pushes = BatchedMean(processes)
        polynomials = Polynomials(added(summed_up(processes), mean_function.coefficients))
        most = POLYNOMIALS_PER_PUSH * len(processes[0].outputs)
        self._summed_up = polynomials if polynomials.size <= most else None

    def evaluate(self, queries: Array) -> tuple[Array, Array]:
        """Mean (m, k) and Jacobian (m, k, 2) at (m, 2) queries."""
        if self._summed_up is not None and covers(queries):
            return self._summed_up.evaluate(queries)
        expected, expected_jacobian = self._mean_function.evaluate(*queries.T)
        mean, jacobian = self._over_pushes.evaluate(queries)
        return expected + mean, expected_jacobian + jacobian
