"""The solution of a QP, and whether it may be used."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

_SOLVED_STATUS = (1, 2)  # OSQP's solved, and solved inaccurately
_ITERATION_LIMIT = 7
_LARGEST_RESIDUAL = 0.1
"""Largest violation of a constraint at which an unfinished solution may be used, in the solver's
units: 0.1 mm, 1 mrad, 1 mm/s."""


@dataclass(frozen=True)
class Solution:
    """Solution of the QP; its arrays are valid until the next solve.

    Attributes:
        inputs: deviations of the inputs from the nominal (N, m).
        states: deviations of the states (N + 1, 4), in the solver's units.
        cost: of the whole horizon, in the solver's scale.
        status: of the solver, 1 = solved.
        iterations: of the solver.
        residual: largest violation of a constraint that must hold, in the solver's units.
    """

    inputs: Array
    states: Array
    cost: float
    status: int
    iterations: int
    residual: float

    @property
    def usable(self) -> bool:
        """Whether the inputs are finite and keep the constraints.

        At the iteration limit the inputs may be suboptimal, but must satisfy dynamics and bounds:
        the residual of an infeasible problem stays large.
        """
        unfinished = self.status == _ITERATION_LIMIT and self.residual <= _LARGEST_RESIDUAL
        usable = unfinished or self.status in _SOLVED_STATUS
        return usable and bool(np.isfinite(self.inputs).all())
