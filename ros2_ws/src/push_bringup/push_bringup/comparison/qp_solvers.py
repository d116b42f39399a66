"""The same QP by several solvers: update the numbers, solve, return the variables.

Each is used as its documentation advises for a sequence of QPs of one sparsity. The QP is that of
the controller, in its units; `OSQP as installed` gets it in SI units. Solvers of the extra `bench`
are imported when they are constructed.
"""

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np
import osqp
from push_core.geometry import Array
from push_mpc.qp import OSQP_SETTINGS, Problem
from scipy import sparse
from scipy.linalg import solve_triangular


class Solver(Protocol):
    """Solves a sequence of QPs that differ only in their numbers."""

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """Variables (n,) in the problem's units, and the number of iterations."""


class Osqp:
    """OSQP: set up once, updated and warm-started."""

    def __init__(self, first: Problem, **settings: Any) -> None:
        self._solver = osqp.OSQP()
        cost = _upper(first)
        # OSQP writes later numbers into the matrix that it was set up with
        matrix, low, high = first.matrix.copy(), first.low.copy(), first.high.copy()
        self._solver.setup(cost, first.linear.copy(), matrix, low, high, verbose=False, **settings)

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """See `Solver`."""
        self._solver.update(
            Ax=problem.matrix.data, q=problem.linear, l=problem.low, u=problem.high
        )
        result = self._solver.solve(raise_error=False)
        return result.x, int(result.info.iter)


def ours(first: Problem) -> Osqp:
    """OSQP with the settings of the controller."""
    return Osqp(first, **{key: OSQP_SETTINGS[key] for key in OSQP_SETTINGS if key != 'verbose'})


def exact(first: Problem) -> Osqp:
    """The reference for the others: tolerance 1e-9, polished, without a limit of time."""
    return Osqp(first, eps_abs=1e-9, eps_rel=1e-9, max_iter=200_000, polishing=True, scaling=0)


class InstalledWarm:
    """OSQP with its defaults, in SI units, updated."""

    def __init__(self, first: Problem) -> None:
        self._solver = Osqp(first.in_si_units())

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """See `Solver`."""
        return self._solver.solve(problem)


class InstalledCold:
    """OSQP with its defaults, in SI units, set up again for each QP."""

    def __init__(self, _first: Problem) -> None:
        pass

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """See `Solver`."""
        return Osqp(problem).solve(problem)


class Daqp:
    """DAQP, an active-set method, on the condensed QP over the inputs."""

    def __init__(self, first: Problem) -> None:
        import daqp  # noqa: PLC0415

        self._model = daqp.Model()
        self._sense = np.where(_is_equation(first)[first.states :], 5, 0).astype(np.int32)
        hessian, gradient, rows, low, high = _condensed(first)[:5]
        self._model.setup(hessian, gradient, rows, high, low, self._sense)

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """See `Solver`."""
        hessian, gradient, rows, low, high, offset, effect = _condensed(problem)
        self._model.update(hessian, gradient, rows, high, low)
        inputs, _, _, info = self._model.solve()
        return np.concatenate([offset + effect @ inputs, inputs]), int(info['iterations'])


class Piqp:
    """PIQP, an interior-point method."""

    def __init__(self, first: Problem) -> None:
        import piqp  # noqa: PLC0415

        self._solver = piqp.SparseSolver()
        self._split = _Split(first)
        self._cost = _upper(first)
        self._solver.setup(self._cost, first.linear, *self._split.parts(first))

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """See `Solver`."""
        self._solver.update(self._cost, problem.linear, *self._split.parts(problem))
        self._solver.solve()
        return np.array(self._solver.result.x), int(self._solver.result.info.iter)


class ProxQp:
    """ProxQP, a proximal method."""

    def __init__(self, first: Problem) -> None:
        import proxsuite  # noqa: PLC0415

        self._split = _Split(first)
        self._cost = sparse.csc_matrix(sparse.diags_array(first.cost))
        parts = self._split.parts(first)
        qp = proxsuite.proxqp
        self._solver = qp.sparse.QP(first.linear.size, parts[0].shape[0], parts[2].shape[0])
        self._solver.settings.initial_guess = qp.WARM_START_WITH_PREVIOUS_RESULT
        self._solver.init(first.cost, first.linear, *parts)

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """See `Solver`."""
        self._solver.update(problem.cost, problem.linear, *self._split.parts(problem))
        self._solver.solve()
        results = self._solver.results
        return np.array(results.x), int(results.info.iter)


class Clarabel:
    """Clarabel, an interior-point method without warm start."""

    def __init__(self, first: Problem) -> None:
        import clarabel  # noqa: PLC0415

        self._clarabel = clarabel
        self._settings = clarabel.DefaultSettings()
        self._settings.verbose = False
        self._split = _Split(first)
        self._cost = _upper(first)

    def solve(self, problem: Problem) -> tuple[Array, int]:
        """See `Solver`."""
        equations, right, rows, low, high = self._split.parts(problem)
        below, above = np.isfinite(low), np.isfinite(high)
        stacked = sparse.vstack([equations, rows[above], -rows[below]], format='csc')
        limits = np.concatenate([right, high[above], -low[below]])
        zero, positive = self._clarabel.ZeroConeT, self._clarabel.NonnegativeConeT
        cones = [zero(right.size), positive(limits.size - right.size)]
        solution = self._clarabel.DefaultSolver(
            self._cost, problem.linear, stacked, limits, cones, self._settings
        ).solve()
        return np.array(solution.x), int(solution.iterations)


SOLVERS: dict[str, Callable[[Problem], Solver]] = {
    'ours (OSQP)': ours,
    'OSQP as installed, warm': InstalledWarm,
    'OSQP as installed, cold': InstalledCold,
    'DAQP': Daqp,
    'PIQP': Piqp,
    'ProxQP': ProxQp,
    'Clarabel': Clarabel,
}
IN_SI_UNITS = ('OSQP as installed, warm', 'OSQP as installed, cold')


class _Split:
    """Splits the constraints into equations and inequalities; the split never changes."""

    def __init__(self, first: Problem) -> None:
        self._equations = _is_equation(first)

    def parts(self, problem: Problem) -> tuple[Any, Array, Any, Array, Array]:
        """Matrix and right-hand side of the equations; matrix, lower and upper bounds."""
        rows = problem.matrix.tocsr()
        equal, free = self._equations, ~self._equations
        return (
            rows[equal].tocsc(),
            problem.low[equal],
            rows[free].tocsc(),
            problem.low[free],
            problem.high[free],
        )


def _upper(problem: Problem) -> Any:
    """The upper triangle of the cost, which is symmetric."""
    return sparse.csc_matrix(sparse.triu(problem.cost))


def _is_equation(problem: Problem) -> Array:
    return np.asarray(problem.low == problem.high)


def _condensed(problem: Problem) -> tuple[Array, ...]:
    """The condensed QP, over the inputs only.

    Returns:
        Hessian, gradient, rows, lower and upper bounds; then offset and effect of the states
        x = offset + effect @ inputs.
    """
    n = problem.states
    dense = problem.matrix.toarray()
    dynamics = np.column_stack([problem.low[:n], -dense[:n, n:]])
    solved = solve_triangular(
        dense[:n, :n], dynamics, lower=True, unit_diagonal=True, check_finite=False
    )
    offset, effect = solved[:, 0], solved[:, 1:]
    cost = problem.cost.toarray()
    weighted = cost[:n, :n] @ effect
    hessian = effect.T @ weighted + cost[n:, n:]
    gradient = problem.linear[n:] + effect.T @ problem.linear[:n] + weighted.T @ offset
    rows = dense[n:, :n] @ effect + dense[n:, n:]
    shift = dense[n:, :n] @ offset
    low, high = problem.low[n:] - shift, problem.high[n:] - shift
    return hessian, gradient, rows, low, high, offset, effect
