"""Refines a lookup table of a model until it is accurate enough.

`tabulation` is a generator: it yields queries and is sent their results, so that a ROS client or a
direct call can drive it. The table is compared with the model between its grid points, in units of
the model's standard deviation: errors well below that are accepted.
"""

from collections.abc import Generator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from push_core.geometry import Array

from push_mpc.motion import travel_rates
from push_mpc.table.domain import Domain
from push_mpc.table.surrogate import Grid, Table

GRIDS = ((37, 61), (73, 121), (145, 241))
"""Points along p_y and along beta, coarse to fine."""

TOLERANCE = 0.05
"""Largest error of the table that ends the refinement, in standard deviations of the model."""

CHECKS = 256
MOST_AT_ONCE = 4096
"""Pushes in one query; few enough that its result does not delay the 10 ms loop."""


@dataclass(frozen=True)
class Query:
    """A batch of pushes to evaluate the model at.

    Attributes:
        p_y: (n,) contact offsets [m].
        beta: (n,) push directions [rad].
        want_variance: whether the variance is needed.
    """

    p_y: Array
    beta: Array
    want_variance: bool = False


@dataclass(frozen=True)
class QueryResult:
    """The result of a query, per metre of travel.

    Attributes:
        mean: (n, 3) displacement rates [1, 1, rad/m].
        jacobian: (n, 3, 2) their derivatives by [p_y, beta].
        variance: (n, 3) of the rates, (0, 3) if the query did not want it.
    """

    mean: Array
    jacobian: Array
    variance: Array

    @classmethod
    def of(cls, mean: Array, jacobian: Array, variance: Array, distance: float) -> 'QueryResult':
        """From displacements after a push of length `distance` [m], as the model returns them."""
        return cls(*travel_rates(mean, jacobian, distance), variance / distance**2)


@dataclass(frozen=True)
class Tabulated:
    """A table and its accuracy.

    Attributes:
        table: of the model.
        size: grid points along p_y and along beta.
        error: largest one measured, in standard deviations; NaN if the model has no variance.
        data: domain of the training data.
    """

    table: Table
    size: tuple[int, int]
    error: float
    data: Domain

    def __str__(self) -> str:
        size = f'{self.size[0]} x {self.size[1]} points'
        if np.isnan(self.error):
            return f'{size}; the model has no variance to compare errors with'
        return f'{size}, error at most {self.error:.2g} standard deviations of the model'


Tabulation: TypeAlias = Generator[Query, QueryResult, Tabulated]


@dataclass(frozen=True)
class ModelScope:
    """What a table of a model has to cover.

    Attributes:
        data: domain of the training data.
        kind: gp or analytical; the analytical model has no variance.
        mean_function: zero or analytical: the prediction far from all data.
        side: length of the pushed face [m].
    """

    data: Domain
    kind: str
    mean_function: str
    side: float

    @property
    def covered(self) -> Domain:
        """Domain of the table; inputs outside are clamped to its edge.

        Far from the data a zero mean predicts no motion, so that the edge of the data is the
        better guess; the motion cone holds on the whole face.
        """
        return self.data if self.mean_function == 'zero' else Domain.of_face(self.side)


def tabulation(scope: ModelScope) -> Tabulation:
    """Refines a table until it is accurate enough or has the finest grid.

    The table of a model without variance is not refined.

    Raises:
        InputError: a result is not finite.
    """
    checks = scope.covered.scattered(CHECKS)
    known = scope.kind == 'gp'
    truth = yield Query(*checks, want_variance=known)
    deviation = np.sqrt(np.maximum(truth.variance, np.finfo(float).tiny))
    for size in GRIDS:
        grid = scope.covered.grid(size)
        table = Table(grid, *(yield from _evaluated(grid)))
        if not known:
            return Tabulated(table, size, float('nan'), scope.data)
        error = float(np.max(np.abs(table.evaluate(*checks)[0] - truth.mean) / deviation))
        if error <= TOLERANCE:
            break
    return Tabulated(table, size, error, scope.data)


def _evaluated(grid: Grid) -> Generator[Query, QueryResult, tuple[Array, Array]]:
    """Mean and Jacobian at all points of a grid, queried in parts."""
    p_y, beta = grid.points()
    results = []
    for first in range(0, p_y.size, MOST_AT_ONCE):
        part = slice(first, first + MOST_AT_ONCE)
        results.append((yield Query(p_y[part], beta[part])))
    mean = np.concatenate([result.mean for result in results])
    return mean, np.concatenate([result.jacobian for result in results])
