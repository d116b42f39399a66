"""The equations of motion over each step of the horizon, linearised along the last plan.

The implicit midpoint rule x_{i+1} = x_i + h f((x_i + x_{i+1}) / 2, u_i), one Newton step of which
is a linear system. The iteration goes on from tick to tick: this is the real-time iteration of
Diehl, Bock and Schloeder 2005 with multiple shooting; see Gros et al. 2020.
"""

import numpy as np
from push_core.geometry import Array

from push_mpc.motion import Expansion, Motion
from push_mpc.qp.last_plan import LastPlan

_LARGEST_GROWTH = 0.5
"""Largest growth of p_y in half a step: the rule has a pole at 1, beyond any real pusher."""


class MidpointRule:
    """Linearised steps in arrays that are made once.

    Attributes:
        dynamics: [A, B, c, D] of each step (N, 4, 4 + m + 1 + 3): in deviations from the nominal
            x_{i+1} = A x_i + B u_i + c + D d, with the model error d, a twist per metre of travel.
    """

    def __init__(self, steps: int, inputs: int) -> None:
        """Makes the arrays for N steps and m inputs."""
        self._expansion = Expansion(steps, inputs)
        self.dynamics = np.zeros((steps, 4, 8 + inputs))
        self._inputs_end = 4 + inputs
        self._state, self._middle = np.zeros((steps, 4)), np.zeros((steps, 4))
        self._input = np.zeros((steps, inputs))
        self._product = np.zeros((steps, 4))
        self._row = np.zeros((steps, 8 + inputs))
        self._growth = np.zeros(steps)

    def linearise(
        self, motion: Motion, nominal: tuple[Array, Array, Array], last: LastPlan, step: float
    ) -> None:
        """Computes `dynamics`.

        Args:
            motion: of object and contact.
            nominal: its states at the ends of the steps (N + 1, 4); its inputs, mean over each
                step (N, m); what its rates have beyond the motion (N, 4).
            last: deviations about which the motion is linearised.
            step: duration of a step [s].
        """
        states, inputs, excess = nominal
        middle, state = self._middle, self._state
        np.add(last.states[1:], last.states[:-1], out=middle)
        middle *= 0.5
        np.add(states[1:], states[:-1], out=state)
        state *= 0.5
        state += middle
        np.add(inputs, last.inputs, out=self._input)
        motion.expand(state, self._input, self._expansion)
        self._fill(step)
        self._add_drift(states, excess, last, step)
        self._solve(0.5 * step)

    def _fill(self, step: float) -> None:
        """Right-hand sides of (I - h/2 F) x_{i+1} = ..., without c."""
        dynamics, found = self.dynamics, self._expansion
        dynamics[:, :, :4] = np.eye(4)
        np.multiply(found.by_heading[:, :2], 0.5 * step, out=dynamics[:, :2, 2])
        np.multiply(found.by_contact, 0.5 * step, out=self._product)
        dynamics[:, :, 3] += self._product
        np.multiply(found.by_input, step, out=dynamics[:, :, 4 : self._inputs_end])
        np.multiply(found.by_twist, step, out=dynamics[:, :, self._inputs_end + 1 :])

    def _add_drift(self, states: Array, excess: Array, last: LastPlan, step: float) -> None:
        """The motion of the model from the last plan on, minus that of the nominal."""
        drift, found = self.dynamics[:, :, self._inputs_end], self._expansion
        np.add(found.rates, excess, out=drift)
        slopes = [found.by_heading, found.by_contact, *np.moveaxis(found.by_input, 2, 0)]
        values = [self._middle[:, 2], self._middle[:, 3], *last.inputs.T]
        for slope, value in zip(slopes, values, strict=True):
            np.multiply(slope, value[:, None], out=self._product)
            drift -= self._product
        drift *= step
        drift += states[:-1]
        drift -= states[1:]

    def _solve(self, half: float) -> None:
        """Back-substitution: no rate depends on x, y; that of p_y only on p_y."""
        dynamics, found, row = self.dynamics, self._expansion, self._row
        np.multiply(found.by_contact[:, 3], -half, out=self._growth)
        np.maximum(self._growth, -_LARGEST_GROWTH, out=self._growth)
        self._growth += 1.0
        dynamics[:, 3] /= self._growth[:, None]
        for index in (2, 0, 1):
            np.multiply(dynamics[:, 3], found.by_contact[:, index, None], out=row)
            row *= half
            dynamics[:, index] += row
        for index in (0, 1):
            np.multiply(dynamics[:, 2], found.by_heading[:, index, None], out=row)
            row *= half
            dynamics[:, index] += row
