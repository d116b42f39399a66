"""Means and Jacobians at a cost that does not depend on the number of pushes.

The pushes are summed once into a small table of coefficients between the features of p_y and those
of beta; an answer is then two matrix products, exact to round-off within the domain.
"""

from collections.abc import Sequence

import numpy as np
from push_core.frames import Array

from push_gp.domain import CENTRE, COVERED
from push_gp.folded_process import Process
from push_gp.kernel_features import (
    MOST_FEATURES,
    enough_features,
    feature_slopes,
    features,
)


class FeatureMean:
    """The posterior mean of k processes that share their inputs, folded into coefficients."""

    def __init__(self, processes: Sequence[Process]) -> None:
        """Folds the pushes in; see `suits` for what processes."""
        self._lengthscales = _lengthscales(processes)
        self._count = _feature_count(self._lengthscales)
        weights = [gp.weights * gp.hyperparameters.signal_std**2 for gp in processes]
        across, around = _by_input(features(self._scaled(processes[0].inputs), self._count))
        weighted = across * np.stack(weights)[:, None]
        self._coefficients = weighted @ np.swapaxes(around, 1, 2)

    @staticmethod
    def size(processes: Sequence[Process]) -> int:
        """How many features of each input there are."""
        return _feature_count(_lengthscales(processes))

    @staticmethod
    def suits(processes: Sequence[Process]) -> bool:
        """Whether the lengthscales are long enough for a small table."""
        return FeatureMean.size(processes) <= MOST_FEATURES

    def evaluate(self, queries: Array) -> tuple[Array, Array]:
        """Mean (m, k) and Jacobian (m, k, 2) at (m, 2) queries within the domain."""
        a = self._scaled(queries)
        values = features(a, self._count)
        across, around = _by_input(values)
        across_slope, around_slope = _by_input(feature_slopes(a, values))
        by_across = self._coefficients @ around
        by_around = np.swapaxes(self._coefficients, 1, 2) @ across
        jacobian = np.empty((len(queries), len(self._lengthscales), 2))
        jacobian[..., 0] = _summed(across_slope, by_across)
        jacobian[..., 1] = _summed(around_slope, by_around)
        jacobian /= self._lengthscales
        return _summed(across, by_across), jacobian

    def _scaled(self, points: Array) -> Array:
        """(2, k, m) offsets from the centre in each process's lengthscales, for (m, 2) points."""
        offsets = (points - CENTRE).T[:, None, :]
        return np.asarray(offsets / self._lengthscales.T[:, :, None])


def _lengthscales(processes: Sequence[Process]) -> Array:
    return np.array([gp.hyperparameters.lengthscales for gp in processes])


def _feature_count(lengthscales: Array) -> int:
    return enough_features(float((COVERED / lengthscales).max()))


def _by_input(values: Array) -> tuple[Array, Array]:
    """(p, 2, k, m) as (k, p, m) for p_y and (k, p, m) for beta."""
    across, around = np.moveaxis(values, (1, 2), (0, 1))
    return across, around


def _summed(left: Array, right: Array) -> Array:
    """(m, k) sums of products over the features of (k, p, m)."""
    return np.asarray(np.einsum('kpm,kpm->mk', left, right))
