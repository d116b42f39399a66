"""The real-time iteration: each QP is linearised along the solution of the last one."""

import numpy as np
from push_core.geometry import Array

from push_mpc.qp.last_plan import LastPlan
from push_mpc.qp.midpoint_rule import MidpointRule
from push_mpc.qp.solution import Solution
from push_mpc.qp.stages import STATE_SCALE
from push_mpc.qp.steering import StagedPlan


class RealTimeIteration:
    """Linearises the horizon before the poses arrive, and keeps the solution found for them.

    Source: Diehl, Bock and Schloeder 2005, preparation and feedback phase.
    """

    def __init__(self, steps: int, inputs: int, *, relinearise: bool) -> None:
        """Makes the arrays.

        Args:
            steps: N of the horizon.
            inputs: m.
            relinearise: whether to linearise along the last solution, not about the nominal.
        """
        self._relinearises = relinearise
        self._last = LastPlan(steps, inputs)
        self._rule = MidpointRule(steps, inputs)
        self._states, self._inputs = np.zeros((steps + 1, 4)), np.zeros((steps, inputs))
        self._excess = np.zeros((steps, 4))

    def prepare(self, staged: StagedPlan, samples: Array) -> Array:
        """The dynamics, see `MidpointRule`, over the horizon at samples (N + 1,) of a plan."""
        self._last.shift(int(samples[0]), staged.stride)
        np.take(staged.plan.state, samples, axis=0, out=self._states, mode='clip')
        np.take(staged.mean_input, samples[:-1], axis=0, out=self._inputs, mode='clip')
        np.take(staged.excess, samples[:-1], axis=0, out=self._excess, mode='clip')
        nominal = self._states, self._inputs, self._excess
        self._rule.linearise(staged.motion, nominal, self._last, staged.step)
        return self._rule.dynamics

    def keep(self, solution: Solution) -> None:
        """Keeps a solution for the next horizon; one that is not usable is forgotten."""
        if not (self._relinearises and solution.usable):
            self.forget()
            return
        np.multiply(solution.states, STATE_SCALE, out=self._states)
        self._last.keep(self._states, solution.inputs)

    def forget(self) -> None:
        """Linearises the next horizon along the nominal."""
        self._last.forget()
