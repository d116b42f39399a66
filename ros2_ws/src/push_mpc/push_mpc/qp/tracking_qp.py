"""The QP of one tick: set up once, then prepare and solve in every tick.

    min  sum_i  (x_i - g_i)^T Q (x_i - g_i) + (u_i - h_i)^T R (u_i - h_i)
         + (u_0 - b)^T S (u_0 - b) + sum_i (u_{i+1} - u_i)^T T (u_{i+1} - u_i)
    s.t. x_{i+1} = A_i x_i + B_i u_i + c_i,  x_0 given,
         bounds on p_y of every state but the first, and on combinations of each u_i

in deviations from the nominal. c, g and h are linear in the disturbance; b is the last command. S
penalises the change from that command, which follows the measurement noise otherwise. T does the
same for later inputs: without it a fast move is cheaper in the second step than in the first, and
is put off from tick to tick. OSQP gets the problem in millimetres, with the cost divided by the
largest weight. With this scaling its longest solve times are an order of magnitude shorter than in
SI units, and its own scaling only takes time. The first input is within 2e-4 m/s of that of an
independent solver; polishing would remove this difference for a third more time.
"""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from push_core.geometry import Array
from scipy import sparse

from push_mpc.qp.constraint_matrix import ConstraintMatrix
from push_mpc.qp.problem import Problem
from push_mpc.qp.relaxed_qp import RelaxedQP
from push_mpc.qp.solution import Solution
from push_mpc.qp.solver import forget, run, set_up, upper_triangle
from push_mpc.qp.stages import NX, STATE_SCALE, InputSpace, Stages


@dataclass(frozen=True)
class QPWeights:
    """Diagonals of the cost.

    Attributes:
        state: of Q (4,) [1/m^2, 1/m^2, 1/rad^2, 1/m^2]; also of Q_N.
        input: of R (m,), per squared unit of each input.
        change: of S (m,), likewise.
        smoothness: of T (m,), likewise.
    """

    state: Array
    input: Array
    change: Array
    smoothness: Array


class TrackingQP:
    """A QP of fixed sparsity and its OSQP solver; only numbers change from tick to tick."""

    def __init__(self, steps: int, space: InputSpace, weights: QPWeights) -> None:
        """Sets the solver up.

        Args:
            steps: N, length of the horizon.
            space: the inputs u, m of them.
            weights: of the cost.
        """
        self.steps = steps
        self._space = space
        self._states = NX * (steps + 1)
        self._size = self._states + space.size * steps
        self._constraints = ConstraintMatrix(steps, space)
        self._matrix = self._constraints.matrix
        rows = self._matrix.shape[0]
        self._low, self._high = np.zeros(rows), np.zeros(rows)
        self._drift = np.zeros((steps, NX, 4))
        self._targets = np.zeros((steps, NX + space.size, 3))
        self._aims = np.zeros((steps, NX + space.size))
        self._inputs = np.zeros((steps, space.size))
        self._set_cost(weights)
        self._linear = np.zeros(self._size)
        self._disturbance = np.ones(4)
        self._widening = 0.0
        self._solver = set_up(self._cost, self._linear, self._matrix)
        self._contact_rows = self._limited(np.arange(rows))[:, 0]
        self._relaxed = RelaxedQP(self._cost, self._matrix, self._contact_rows)
        self._variables = np.zeros(self._size)

    def weigh(self, weights: QPWeights) -> None:
        """Changes the weights, between two ticks; takes as long as `prepare`."""
        self._set_cost(weights)
        self._solver.update(Px=upper_triangle(self._cost).data)
        self._relaxed.weigh(self._cost)

    def limit(self, limited: Array) -> None:
        """Changes the combinations of the inputs that are bounded, from the next `prepare` on.

        Args:
            limited: see `InputSpace`; zeros stay zeros.
        """
        self._constraints.limit(limited)

    def forget(self) -> None:
        """Lets the next solve depend on no earlier one."""
        forget(self._solver)
        self._relaxed.forget()

    def prepare(self, stages: Stages, window: Array, first: Stages, dynamics: Array) -> None:
        """Loads everything that does not depend on the state: most of the work of a tick.

        Copies into arrays that exist; allocates none.

        Args:
            stages: of the whole plan.
            window: indices (N,) of those in the horizon.
            first: its limits replace those of the first stage.
            dynamics: [A, B, c, D] of each step (N, 4, 4 + m + 1 + 3) in SI units; see
                `MidpointRule`.
        """
        self._constraints.load(dynamics)
        np.divide(dynamics[:, :, -4:], STATE_SCALE[:, None], out=self._drift)
        np.take(stages.target, window, axis=0, out=self._targets, mode='clip')
        np.take(stages.low, window, axis=0, out=self._limited(self._low), mode='clip')
        np.take(stages.high, window, axis=0, out=self._limited(self._high), mode='clip')
        self._limited(self._low)[0] = first.low[window[0]]
        self._limited(self._high)[0] = first.high[window[0]]
        self._widening = 0.0
        self._solver.update(Ax=self._matrix.data)

    def solve(self, start: Array, widening: float, disturbance: Array, before: Array) -> Solution:
        """Solves the prepared problem, warm-started with the last solution.

        Without a usable solution, bounds on p_y may be violated; see `RelaxedQP`.

        Args:
            start: deviation x_0 (4,) from the nominal [m, m, rad, m].
            widening: added to the bounds of p_y on both sides [m].
            disturbance: model error, a twist per metre of travel (3,) [1, 1, rad/m].
            before: b, the last command minus the present nominal input (m,).
        """
        self._disturb(disturbance)
        self._first_inputs(self._linear)[:] -= self._change * (before / self._space.scale)
        np.divide(start, STATE_SCALE, out=self._low[:NX])
        self._high[:NX] = self._low[:NX]
        wider = (widening - self._widening) / STATE_SCALE[3]
        self._limited(self._low)[:, 0] -= wider
        self._limited(self._high)[:, 0] += wider
        self._widening = widening
        self._solver.update(q=self._linear, l=self._low, u=self._high)
        solution = self._solution(run(self._solver))
        if solution.usable:
            return solution
        relaxed = self._relaxed.solve(self._matrix.data, self._linear, self._low, self._high)
        again = self._solution(relaxed)
        residual = float(self._split_violations()[0].max())
        return replace(again, iterations=solution.iterations + again.iterations, residual=residual)

    def _solution(self, result: Any) -> Solution:
        """A result of OSQP, with the inputs in SI units."""
        self._variables[:] = result.x[: self._size]
        inputs = self._variables[self._states :].reshape(self.steps, -1)
        np.multiply(inputs, self._space.scale, out=self._inputs)
        info = result.info
        return Solution(
            self._inputs,
            self._variables[: self._states].reshape(-1, NX),
            float(info.obj_val),
            int(info.status_val),
            int(info.iter),
            float(info.prim_res),
        )

    def largest_violation(self) -> str:
        """What the latest solution violates, the bounds on p_y apart, by how much in SI units."""
        others, contact = self._split_violations()
        if not np.isfinite(others).all():
            return 'its solution is not a number'
        row = int(others.argmax())
        amount, beyond = others[row] * self._row_units()[row], contact.max() * STATE_SCALE[3]
        name = self._row_name(row)
        return f'{name} is violated by {amount:.2g}, p_y is {beyond:.2g} m beyond its bounds'

    def _split_violations(self) -> tuple[Array, Array]:
        """Violation of each row by the latest solution, without and of the bounds on p_y."""
        activity = self._matrix @ self._variables
        every = np.maximum(self._low - activity, activity - self._high).clip(min=0.0)
        contact = every[self._contact_rows]
        every[self._contact_rows] = 0.0
        return every, contact

    def _row_name(self, row: int) -> str:
        if row < self._states:
            stage, which = divmod(row, NX)
            return f'{("x [m]", "y [m]", "theta [rad]", "p_y [m]")[which]} of state {stage}'
        names = ('p_y [m]', *self._space.names)
        stage, which = divmod(row - self._states, len(names))
        return f'{names[which]} in step {stage + 1} of {self.steps}'

    def _row_units(self) -> Array:
        """SI values of the units of the rows."""
        steps = self.steps
        return np.concatenate(
            [np.tile(STATE_SCALE, steps + 1), np.tile(self._space.rows_scale, steps)]
        )

    @property
    def problem(self) -> Problem:
        """A copy of the problem that was solved last."""
        steps, space = self.steps, self._space
        variables = np.concatenate([np.tile(STATE_SCALE, steps + 1), np.tile(space.scale, steps)])
        pattern = self._matrix.indices, self._matrix.indptr
        return Problem(
            self._cost.copy(),
            self._linear.copy(),
            sparse.csc_matrix((self._matrix.data.copy(), *pattern), shape=self._matrix.shape),
            self._low.copy(),
            self._high.copy(),
            self._states,
            (variables, self._row_units(), self._cost_unit),
        )

    def _disturb(self, disturbance: Array) -> None:
        """Sets the drift c, and the linear part of the cost from the targets g and h."""
        self._disturbance[1:] = disturbance
        drift = self._low[NX : self._states].reshape(-1, NX)
        np.matmul(self._drift, self._disturbance, out=drift)
        self._high[NX : self._states] = self._low[NX : self._states]
        np.matmul(self._targets, disturbance, out=self._aims)
        # the final state has the target of the last stage
        aims = self._linear[: self._states].reshape(-1, NX)
        aims[:-1] = self._aims[:, :NX]
        aims[-1] = self._aims[-1, :NX]
        self._linear[self._states :].reshape(self.steps, -1)[:] = self._aims[:, NX:]
        np.multiply(self._tracking, self._linear, out=self._linear)
        np.negative(self._linear, out=self._linear)

    def _first_inputs(self, variables: Array) -> Array:
        """The entries of the first stage's inputs, as a view (m,)."""
        return variables[self._states : self._states + self._space.size]

    def _limited(self, bounds: Array) -> Array:
        """The bounds of p_y and of the inputs, as a view (N, 1 + k)."""
        return bounds[self._states :].reshape(self.steps, -1)

    def _set_cost(self, weights: QPWeights) -> None:
        self._tracking = self._diagonal(weights.state, weights.input)
        unit = 2.0 * self._space.scale**2 / self._cost_unit
        self._change = unit * weights.change
        diagonal = self._tracking.copy()
        self._first_inputs(diagonal)[:] += self._change
        self._cost = self._with_smoothness(diagonal, unit * weights.smoothness)

    def _diagonal(self, state_weights: Array, input_weights: Array) -> Array:
        """Diagonal of the cost, scaled; doubled because OSQP halves it."""
        state, inputs = state_weights * STATE_SCALE**2, input_weights * self._space.scale**2
        diagonal = np.concatenate([np.tile(state, self.steps + 1), np.tile(inputs, self.steps)])
        self._cost_unit = float(diagonal.max())
        return np.asarray(2.0 * diagonal / self._cost_unit)

    def _with_smoothness(self, diagonal: Array, smoothness: Array) -> sparse.csc_matrix:
        """A diagonal cost (n,) and that of the changes from step to step (m,), symmetric.

        Zeros stay entries, so that weights of zero can be changed.
        """
        inputs = diagonal[self._states :].reshape(self.steps, -1)
        inputs[1:] += smoothness
        inputs[:-1] += smoothness
        index = np.arange(self._size)
        before = index[self._states : -smoothness.size]
        after = before + smoothness.size
        between = -np.tile(smoothness, self.steps - 1)
        values = np.concatenate([diagonal, between, between])
        places = np.concatenate([index, before, after]), np.concatenate([index, after, before])
        return sparse.csc_matrix((values, places))
