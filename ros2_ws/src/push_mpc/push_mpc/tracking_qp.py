"""The quadratic program of one tick: build once, update, solve.

    min  sum_i  x_i^T Q x_i + u_i^T R u_i
    s.t. x_{i+1} = A_i x_i + B_i u_i + c_i,  x_0 given,
         |p_y| bounds on every state but the first, bounds on every input

in deviations from the nominal. OSQP sees the problem in millimetres and with its cost divided by
the largest weight: so scaled, its tail is an order of magnitude shorter than in SI units, and its
own scaling only costs time. Coarse iterations find the active bounds and polishing then solves for
them: 1e-5 m/s from an independent solver's input where the iterations alone end 3e-3 m/s away.
"""

from dataclasses import dataclass

import numpy as np
import osqp
from push_core.frames import Array
from scipy import sparse

NX, NU = 4, 2
# OSQP's solved, solved inaccurately, and out of iterations: near enough to steer by
_USABLE_STATUS = (1, 2, 7)
_STATE_SCALE = np.array([1e-3, 1e-3, 1e-2, 1e-3])
_INPUT_SCALE = np.array([1e-2, 1e-2])
# where a transition can differ from 0: the world position enters no rate
_A_PATTERN = np.array([[1, 0, 1, 1], [0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1]], dtype=bool)
_OSQP = {
    'verbose': False,
    'eps_abs': 3e-4,
    'eps_rel': 3e-4,
    'check_termination': 5,
    'max_iter': 200,
    'adaptive_rho_interval': 25,
    'scaling': 0,
    'polishing': True,
}


@dataclass(frozen=True)
class Solution:
    """What the solver found.

    Attributes:
        inputs: deviations of the inputs from the nominal (N, 2) [m/s].
        status: of the solver, 1 = solved.
        iterations: that it took.
    """

    inputs: Array
    status: int
    iterations: int

    @property
    def usable(self) -> bool:
        """Whether the inputs are finite and not a proof that there are none."""
        return self.status in _USABLE_STATUS and bool(np.isfinite(self.inputs).all())


class TrackingQP:
    """One solver with a fixed sparsity; only numbers change from tick to tick."""

    def __init__(self, steps: int, state_weights: Array, input_weights: Array) -> None:
        """Sets the solver up.

        Args:
            steps: N, length of the horizon.
            state_weights: diagonal of Q (4,) [1/m^2, 1/m^2, 1/rad^2, 1/m^2]; also of Q_N.
            input_weights: diagonal of R (2,) [s^2/m^2].
        """
        self.steps = steps
        self._states = NX * (steps + 1)
        self._size = self._states + NU * steps
        self._matrix = self._constraints()
        self._a_places, self._b_places = self._places()
        self._low = np.zeros(self._matrix.shape[0])
        self._high = np.zeros(self._matrix.shape[0])
        self._solver = osqp.OSQP()
        self._solver.setup(
            sparse.csc_matrix(sparse.diags_array(self._cost(state_weights, input_weights))),
            np.zeros(self._size),
            self._matrix,
            self._low,
            self._high,
            **_OSQP,
        )

    def update(
        self,
        transition: Array,
        effect: Array,
        drift: Array,
        start: Array,
        contact_bounds: tuple[Array, Array],
        input_bounds: tuple[Array, Array],
    ) -> None:
        """Puts in the numbers of one tick.

        Args:
            transition: A_i (N, 4, 4).
            effect: B_i (N, 4, 2).
            drift: c_i (N, 4), how the nominal itself misses the model's motion.
            start: deviation x_0 (4,) from the nominal.
            contact_bounds: lower and upper deviation of p_y, each (N,) [m].
            input_bounds: lower and upper deviation of the inputs, each (N, 2) [m/s].
        """
        scaled_a = transition * (_STATE_SCALE / _STATE_SCALE[:, None])
        scaled_b = effect * (_INPUT_SCALE / _STATE_SCALE[:, None])
        self._matrix.data[self._a_places] = -scaled_a[:, _A_PATTERN].ravel()
        self._matrix.data[self._b_places] = -scaled_b.ravel()
        for bounds, p_y, u in (
            (self._low, contact_bounds[0], input_bounds[0]),
            (self._high, contact_bounds[1], input_bounds[1]),
        ):
            bounds[:NX] = start / _STATE_SCALE
            bounds[NX : self._states].reshape(-1, NX)[:] = drift / _STATE_SCALE
            bounds[self._states : self._states + self.steps] = p_y / _STATE_SCALE[3]
            bounds[self._states + self.steps :].reshape(-1, NU)[:] = u / _INPUT_SCALE
        self._solver.update(Ax=self._matrix.data, l=self._low, u=self._high)

    def solve(self) -> Solution:
        """Solves the problem of the last update, warm-started by the one before."""
        result = self._solver.solve(raise_error=False)
        inputs = result.x[self._states :].reshape(self.steps, NU) * _INPUT_SCALE
        return Solution(inputs, int(result.info.status_val), int(result.info.iter))

    def _cost(self, state_weights: Array, input_weights: Array) -> Array:
        """Diagonal of the cost, scaled; doubled because OSQP halves it."""
        state, inputs = state_weights * _STATE_SCALE**2, input_weights * _INPUT_SCALE**2
        diagonal = np.concatenate([np.tile(state, self.steps + 1), np.tile(inputs, self.steps)])
        return np.asarray(2.0 * diagonal / diagonal.max())

    def _constraints(self) -> sparse.csc_matrix:
        """Rows: initial state and dynamics, then p_y of all states but the first, then inputs."""
        n = self.steps
        shift = sparse.eye_array(n + 1, k=-1)
        previous = sparse.kron(shift, np.where(_A_PATTERN, -1.0, 0.0))
        inputs = sparse.vstack([sparse.csc_array((1, n)), sparse.eye_array(n)])
        dynamics = sparse.hstack(
            [sparse.eye_array(self._states) + previous, sparse.kron(inputs, -np.ones((NX, NU)))]
        )
        contact = sparse.kron(sparse.eye_array(n, n + 1, k=1), np.eye(NX)[3:])
        contact = sparse.hstack([contact, sparse.csc_array((n, NU * n))])
        limits = sparse.hstack(
            [sparse.csc_array((NU * n, self._states)), sparse.eye_array(NU * n)]
        )
        matrix = sparse.csc_matrix(sparse.vstack([dynamics, contact, limits]))
        matrix.sort_indices()
        return matrix

    def _places(self) -> tuple[Array, Array]:
        """Where in the matrix data the entries of A_i (by pattern) and B_i stand, in order."""
        step = np.arange(self.steps)[:, None]
        a_row, a_column = np.nonzero(_A_PATTERN)
        b_row, b_column = np.indices((NX, NU)).reshape(2, -1)
        rows_below = NX * (step + 1)
        a = self._data_index(rows_below + a_row, NX * step + a_column)
        b = self._data_index(rows_below + b_row, self._states + NU * step + b_column)
        return a, b

    def _data_index(self, rows: Array, columns: Array) -> Array:
        """Index into the matrix data of entries that exist, flattened."""
        count = self._matrix.nnz
        numbered = sparse.csc_array(
            (np.arange(1.0, count + 1.0), self._matrix.indices, self._matrix.indptr),
            shape=self._matrix.shape,
        ).todok()
        pairs = zip(rows.ravel(), columns.ravel(), strict=True)
        return np.array([int(numbered[int(row), int(column)]) - 1 for row, column in pairs])
