"""The QP of a tick with bounds on p_y that may be violated at a price; it always has a solution.

    min  cost of the QP + w sum_i (over_i + under_i)
    s.t. its constraints, but low_i <= p_y,i + under_i - over_i <= high_i for every state,
         over_i >= 0, under_i >= 0

The penalty is exact: where the bounds can be kept and their multipliers are below w, the solution
is that of the QP. It is solved only where OSQP finds no solution of the QP itself: solved in every
tick it needs twice the iterations.
"""

from typing import Any

import numpy as np
from push_core.geometry import Array
from scipy import sparse

from push_mpc.qp.solver import forget, run, set_up, upper_triangle

_WEIGHT = 100.0
"""w, in the solver's units. With ten times as much, one QP of three needs more than the iteration
limit."""


class RelaxedQP:
    """See the module; set up once, only numbers change from solve to solve."""

    def __init__(self, cost: sparse.csc_matrix, matrix: sparse.csc_matrix, soft: Array) -> None:
        """Sets the solver up.

        Args:
            cost: quadratic cost of the QP (n, n).
            matrix: of its constraints (rows, n); the sparsity stays.
            soft: indices of the rows that may be violated (k,).
        """
        rows, size = matrix.shape
        violations = 2 * soft.size
        self._entries_given = matrix.nnz
        self._linear = np.concatenate([np.zeros(size), np.full(violations, _WEIGHT)])
        self._low = np.zeros(rows + violations)
        self._high = np.concatenate([np.zeros(rows), np.full(violations, np.inf)])
        wider = _with_violations(matrix, soft)
        self._entries = wider.data.copy()
        free = sparse.csc_matrix((violations, violations))
        self._solver = set_up(sparse.block_diag([cost, free]), self._linear.copy(), wider)

    def weigh(self, cost: sparse.csc_matrix) -> None:
        """Changes the quadratic cost of the QP (n, n); the sparsity stays."""
        self._solver.update(Px=upper_triangle(cost).data)

    def forget(self) -> None:
        """Lets the next solve depend on no earlier one."""
        forget(self._solver)

    def solve(self, entries: Array, linear: Array, low: Array, high: Array) -> Any:
        """OSQP's result; its first variables are those of the QP.

        Args:
            entries: data of the constraint matrix of the QP.
            linear: linear cost (n,).
            low: lower bounds (rows,).
            high: upper bounds (rows,).
        """
        self._entries[: self._entries_given] = entries
        self._linear[: linear.size] = linear
        self._low[: low.size] = low
        self._high[: high.size] = high
        self._solver.update(Ax=self._entries)
        self._solver.update(q=self._linear, l=self._low, u=self._high)
        return run(self._solver)


def _with_violations(matrix: sparse.csc_matrix, soft: Array) -> sparse.csc_matrix:
    """Appends columns and bounds of the violations; the entries given come first in the data."""
    rows, count = matrix.shape[0], soft.size
    under = sparse.csc_matrix((np.ones(count), (soft, np.arange(count))), shape=(rows, count))
    violations = sparse.vstack([sparse.hstack([under, -under]), sparse.eye_array(2 * count)])
    given = sparse.vstack([matrix, sparse.csc_matrix((2 * count, matrix.shape[1]))])
    wider = sparse.csc_matrix(sparse.hstack([given, violations]))
    wider.sort_indices()
    return wider
