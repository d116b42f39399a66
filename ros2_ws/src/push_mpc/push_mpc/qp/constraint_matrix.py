"""The matrix of the constraints of a QP: a sparsity that is fixed, numbers that change.

Rows: initial state and dynamics; then, for each stage, the next p_y and its bounded inputs.
"""

import numpy as np
from push_core.geometry import Array
from scipy import sparse

from push_mpc.qp.stages import A_PATTERN, NX, STATE_SCALE, InputSpace


class ConstraintMatrix:
    """Knows where in the matrix the dynamics of each step and the bounds of the inputs stand.

    Attributes:
        matrix: in the units of the solver; its numbers are changed in place.
    """

    def __init__(self, steps: int, space: InputSpace) -> None:
        """Makes the matrix for a horizon of N steps; its dynamics are loaded later."""
        self._steps, self._space = steps, space
        self._states = NX * (steps + 1)
        self.matrix = self._pattern()
        self._places = self._entry_places()
        self._limit_places = self._places_of_limits()
        self._entries = np.zeros((steps, space.entries))
        self._entry_columns, self._entry_scale = self._entry_conversion()

    def load(self, dynamics: Array) -> None:
        """Takes the dynamics of each step (N, 4, 4 + m + 1 + 3), as `TrackingQP.prepare` does."""
        every = dynamics.reshape(self._steps, -1)
        np.take(every, self._entry_columns, axis=1, out=self._entries, mode='clip')
        self._entries *= self._entry_scale
        self.matrix.data[self._places] = self._entries

    def limit(self, limited: Array) -> None:
        """Changes the combinations of inputs that are bounded; zeros stay zeros."""
        self.matrix.data[self._limit_places] = limited[np.nonzero(self._space.limited)]

    def _entry_conversion(self) -> tuple[Array, Array]:
        """Place in `dynamics` and unit of each entry of -A and -B that a stage has."""
        unit = np.concatenate([STATE_SCALE, self._space.scale])
        units = -unit / STATE_SCALE[:, None]
        width = len(unit) + 4
        has = np.hstack([A_PATTERN, np.ones((NX, self._space.size), dtype=bool)])
        row, column = np.nonzero(has)
        # first those of A, then those of B, as in `_entry_places`
        order = np.argsort(column >= NX, kind='stable')
        row, column = row[order], column[order]
        return row * width + column, units[row, column]

    def _pattern(self) -> sparse.csc_matrix:
        """The matrix with the entries of the bounds; those of the dynamics are anything but 0."""
        n = self._steps
        shift = sparse.eye_array(n + 1, k=-1)
        previous = sparse.kron(shift, np.where(A_PATTERN, -1.0, 0.0))
        inputs = sparse.vstack([sparse.csc_array((1, n)), sparse.eye_array(n)])
        effect = -np.ones((NX, self._space.size))
        dynamics = sparse.hstack(
            [sparse.eye_array(self._states) + previous, sparse.kron(inputs, effect)]
        )
        limited_inputs = np.vstack([np.zeros(self._space.size), self._space.limited])
        next_contact = np.zeros((len(limited_inputs), NX))
        next_contact[0, 3] = 1.0
        limited = sparse.hstack(
            [
                sparse.kron(sparse.eye_array(n, n + 1, k=1), next_contact),
                sparse.kron(sparse.eye_array(n), limited_inputs),
            ]
        )
        matrix = sparse.csc_matrix(sparse.vstack([dynamics, limited]))
        matrix.sort_indices()
        return matrix

    def _entry_places(self) -> Array:
        """Index (N, entries) into the matrix data of the entries of each stage."""
        step = np.arange(self._steps)[:, None]
        a_row, a_column = np.nonzero(A_PATTERN)
        inputs = self._space.size
        b_row, b_column = np.indices((NX, inputs)).reshape(2, -1)
        rows = NX * (step + 1) + np.concatenate([a_row, b_row])
        columns = np.hstack([NX * step + a_column, self._states + inputs * step + b_column])
        return self._data_index(rows, columns)

    def _places_of_limits(self) -> Array:
        """Index (N, entries) into the matrix data of the entries of the bounded combinations."""
        step = np.arange(self._steps)[:, None]
        row, column = np.nonzero(self._space.limited)
        rows = self._states + (1 + len(self._space.limited)) * step + 1 + row
        return self._data_index(rows, self._states + self._space.size * step + column)

    def _data_index(self, rows: Array, columns: Array) -> Array:
        """Index into the matrix data of entries that exist, in the shape of `rows`."""
        count = self.matrix.nnz
        numbered = sparse.csc_array(
            (np.arange(1.0, count + 1.0), self.matrix.indices, self.matrix.indptr),
            shape=self.matrix.shape,
        ).todok()
        pairs = zip(rows.ravel(), columns.ravel(), strict=True)
        places = [int(numbered[int(row), int(column)]) - 1 for row, column in pairs]
        return np.reshape(places, rows.shape)
