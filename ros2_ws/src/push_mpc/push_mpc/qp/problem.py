"""The numbers of one QP, for other solvers and for tests."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array
from scipy import sparse


@dataclass(frozen=True)
class Problem:
    """The QP of one tick: min 1/2 z^T cost z + linear^T z, low <= matrix z <= high.

    The variables z are the states, 4 (N + 1) of them, then the inputs. The rows are the dynamics,
    one for each state, then the limits.

    Attributes:
        cost: quadratic part, symmetric (n, n).
        linear: linear part (n,).
        matrix: constraints (rows, n).
        low: lower bounds (rows,).
        high: upper bounds (rows,).
        states: number of states, which is also the number of rows of the dynamics.
        units: SI values of the units of the variables (n,), of the rows (rows,) and of the cost.
    """

    cost: sparse.csc_matrix
    linear: Array
    matrix: sparse.csc_matrix
    low: Array
    high: Array
    states: int
    units: tuple[Array, Array, float]

    def in_si_units(self) -> 'Problem':
        """The same problem in SI units."""
        variables, rows, cost = self.units
        scale = sparse.diags_array(1.0 / variables)
        matrix = sparse.csc_matrix(sparse.diags_array(rows) @ self.matrix @ scale)
        matrix.sort_indices()
        ones = np.ones_like(variables), np.ones_like(rows), 1.0
        return Problem(
            sparse.csc_matrix(cost * (scale @ self.cost @ scale)),
            self.linear * cost / variables,
            matrix,
            self.low * rows,
            self.high * rows,
            self.states,
            ones,
        )
