"""OSQP as the controller uses it."""

import signal
from typing import Any

import numpy as np
import osqp
from push_core.geometry import Array
from scipy import sparse

_INTERRUPTED = 10
OSQP_SETTINGS = {
    'verbose': False,
    'eps_abs': 5e-5,
    'eps_rel': 5e-5,
    'alpha': 1.3,
    'rho': 1.0,
    'check_termination': 5,
    'max_iter': 200,
    'adaptive_rho_interval': 25,
    'adaptive_rho_tolerance': 2.0,
    'scaling': 0,
}


def set_up(cost: sparse.csc_matrix, linear: Array, matrix: sparse.csc_matrix) -> osqp.OSQP:
    """A solver for a symmetric cost (n, n), with bounds of zero until they are updated."""
    solver = osqp.OSQP()
    rows = matrix.shape[0]
    upper = upper_triangle(cost)
    solver.setup(upper, linear, matrix, [0.0] * rows, [0.0] * rows, **OSQP_SETTINGS)
    return solver


def upper_triangle(cost: sparse.csc_matrix) -> sparse.csc_matrix:
    """What OSQP takes of a symmetric cost; entries that are zero stay entries."""
    return sparse.csc_matrix(sparse.triu(cost))


def run(solver: osqp.OSQP) -> Any:
    """OSQP's result for the numbers of the latest update, warm-started with its last solution."""
    result = solver.solve(raise_error=False)
    if result.info.status_val == _INTERRUPTED:
        # OSQP's own handler took the Ctrl-C
        signal.raise_signal(signal.SIGINT)
    return result


def forget(solver: osqp.OSQP) -> None:
    """Lets the next solve depend on no earlier one."""
    rows, size = solver.m, solver.n
    solver.update_settings(rho=OSQP_SETTINGS['rho'])
    solver.warm_start(x=np.zeros(size), y=np.zeros(rows))
