"""What a QP found: its solution, whether it may be used, and the states that it plans."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

from push_mpc.plan import Plan
from push_mpc.qp.stages import STATE_SCALE

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


@dataclass(frozen=True)
class PlannedStates:
    """The planned states over the horizon; valid until the next tick is prepared.

    Attributes:
        plan: the nominal.
        samples: indices into the plan, one for each planned state (N + 1,).
        deviations: of the planned states from these samples (N + 1, 4), in the solver's units.
    """

    plan: Plan
    samples: Array
    deviations: Array

    def write(self, states: Array, scratch: Array) -> None:
        """Writes the states (N + 1, 4) [m, m, rad, m] without allocating.

        Args:
            states: receives the states.
            scratch: array of the same shape, overwritten.
        """
        np.take(self.plan.state, self.samples, axis=0, out=scratch, mode='clip')
        np.multiply(self.deviations, STATE_SCALE, out=states)
        states += scratch
