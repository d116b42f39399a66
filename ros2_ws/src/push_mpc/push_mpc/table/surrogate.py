"""The model as a bicubic lookup table over [p_y, beta].

Its cost does not depend on the size of the training set. Values and first derivatives at the grid
points are the model's, the mixed derivative is a central difference of its Jacobian (bicubic
Hermite interpolation).
"""

from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array

# Hermite basis on [0, 1]: rows are powers of t; columns value at 0, value at 1, slope at 0, at 1
_HERMITE = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [-3, 3, -2, -1], [2, -2, 1, 1]], dtype=float)
_EXPONENTS = np.array([1.0, 2.0, 3.0])
_LARGEST = 1e9  # rate [1, 1, rad/m], or its derivative; real pushes stay below 1000


@dataclass(frozen=True)
class Grid:
    """An even grid over the domain of a model.

    Attributes:
        p_y: contact offsets (m,) [m].
        beta: push directions (k,) [rad].
    """

    p_y: Array
    beta: Array

    def points(self) -> tuple[Array, Array]:
        """All grid points, p_y slow and beta fast, each (m * k,)."""
        p_y, beta = np.meshgrid(self.p_y, self.beta, indexing='ij')
        return p_y.ravel(), beta.ravel()


class Table:
    """Bicubic interpolation of displacement rates; inputs are clamped to the grid.

    Attributes:
        grid: its points.
        low: lowest p_y [m] and beta [rad] (2,).
        step: of the grid (2,).
        cells: number of cells along p_y and along beta (2,).
    """

    def __init__(self, grid: Grid, mean: Array, jacobian: Array) -> None:
        """Builds the table.

        Args:
            grid: of the queries.
            mean: displacement rates (m * k, 3) at `grid.points()` [1, 1, rad/m].
            jacobian: their derivatives (m * k, 3, 2) by [p_y, beta].

        Raises:
            InputError: a value is not finite or implausibly large.
        """
        if not (np.isfinite(mean).all() and np.isfinite(jacobian).all()):
            raise InputError('the model returned values that are not finite')
        if max(np.abs(mean).max(), np.abs(jacobian).max()) > _LARGEST:
            raise InputError('the model returned implausibly large displacement rates')
        self.grid = grid
        self.low = np.array([grid.p_y[0], grid.beta[0]])
        self.step = np.array([grid.p_y[1] - grid.p_y[0], grid.beta[1] - grid.beta[0]])
        self.cells = np.array([grid.p_y.size - 1, grid.beta.size - 1])
        self._axes = (self.low.tolist(), self.step.tolist(), self.cells.tolist())
        self._coefficients = self._fit(mean, jacobian)

    def _fit(self, mean: Array, jacobian: Array) -> Array:
        """Coefficients (m - 1, k - 1, 3, 4, 4) of every cell in its unit coordinates."""
        shape = (self.grid.p_y.size, self.grid.beta.size, 3)
        value = mean.reshape(shape)
        slope_p = jacobian[:, :, 0].reshape(shape) * self.step[0]
        slope_b = jacobian[:, :, 1].reshape(shape) * self.step[1]
        mixed = 0.5 * (np.gradient(slope_p, axis=1) + np.gradient(slope_b, axis=0))
        corners = np.empty((*self.cells, 3, 4, 4))
        for row, pair in enumerate(((value, slope_b), (slope_p, mixed))):
            for column, field in enumerate(pair):
                for i in range(2):
                    for j in range(2):
                        part = field[i : shape[0] - 1 + i, j : shape[1] - 1 + j]
                        corners[..., 2 * row + i, 2 * column + j] = part
        return np.ascontiguousarray(_HERMITE @ corners @ _HERMITE.T)

    @property
    def blocks(self) -> Array:
        """Coefficients (cells, 3, 16) of all cells, in their unit coordinates."""
        return self._coefficients.reshape(-1, 3, 16)

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """Rates (n, 3) [1, 1, rad/m] and Jacobian (n, 3, 2) at p_y [m] and beta [rad], each (n,).

        Outside the grid the derivative across its edge is 0.
        """
        return self.lookup(len(p_y)).evaluate(p_y, beta)

    def lookup(self, points: int) -> 'Lookup':
        """The same for always as many points, in arrays that are made once."""
        return Lookup(self, points)

    def rate(self, p_y: float, beta: float) -> tuple[float, float, float]:
        """Displacement rates [1, 1, rad/m] at one point; fast for a single query."""
        (p_low, b_low), (p_step, b_step), (p_cells, b_cells) = self._axes
        t, i = _unit(p_y, p_low, p_step, p_cells)
        u, j = _unit(beta, b_low, b_step, b_cells)
        by_beta = self._coefficients[i, j] @ (1.0, u, u * u, u * u * u)
        x, y, theta = (by_beta @ (1.0, t, t * t, t * t * t)).tolist()
        return x, y, theta

    def rate_and_slopes(self, p_y: float, beta: float) -> Array:
        """Rates and their slopes (3, 2, 2) at one point: [:, 0, 0] is `rate`.

        [:, 1, 0] is the derivative by p_y, [:, 0, 1] that by beta.
        """
        (p_low, b_low), (p_step, b_step), (p_cells, b_cells) = self._axes
        t, i = _unit(p_y, p_low, p_step, p_cells)
        u, j = _unit(beta, b_low, b_step, b_cells)
        across = np.array([[1.0, t, t * t, t * t * t], _slope(t, p_step)])
        around = np.array([[1.0, u, u * u, u * u * u], _slope(u, b_step)])
        return np.asarray(across @ self._coefficients[i, j] @ around.T)


def _slope(t: float, step: float) -> list[float]:
    """Derivatives of the powers 0..3 of t by the input of which it is 1/step."""
    return [0.0, 1.0 / step, 2.0 * t / step, 3.0 * t * t / step]


class Lookup:
    """Evaluates a table at n points; the results are valid until the next evaluation."""

    def __init__(self, table: Table, points: int) -> None:
        """Makes the arrays for n points."""
        self._table = table
        self._place, self._inside = np.zeros((points, 2)), np.zeros((points, 2))
        self._cell, self._flat = np.zeros((points, 2), dtype=int), np.zeros(points, dtype=int)
        # powers 0..3 of the place within a cell, and their derivatives
        self._powers, self._slopes = np.ones((points, 2, 4)), np.zeros((points, 2, 4))
        self._products = np.zeros((points, 3, 4, 4))
        self._taken = np.zeros((points, 3, 16))
        self._rates = np.zeros((points, 3, 3))

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `Table.evaluate`."""
        self._find_cells(p_y, beta)
        self._take_powers()
        np.take(self._table.blocks, self._flat, axis=0, out=self._taken, mode='clip')
        factors = self._products.reshape(-1, 3, 16).swapaxes(1, 2)
        np.matmul(self._taken, factors, out=self._rates)
        return self._rates[..., 0], self._rates[..., 1:]

    def _find_cells(self, p_y: Array, beta: Array) -> None:
        table, place, inside, cell = self._table, self._place, self._inside, self._cell
        place[:, 0], place[:, 1] = p_y, beta
        place -= table.low
        place /= table.step
        np.maximum(place, 0.0, out=inside)
        np.minimum(inside, table.cells, out=inside)
        np.copyto(cell, inside, casting='unsafe')
        np.minimum(cell, table.cells - 1, out=cell)
        np.multiply(cell[:, 0], table.cells[1], out=self._flat)
        self._flat += cell[:, 1]

    def _take_powers(self) -> None:
        """Factors (n, 3, 4, 4) of a cell's coefficients in the value and in both derivatives."""
        place, inside, powers, slopes = self._place, self._inside, self._powers, self._slopes
        # the derivative across an edge is 0 outside
        np.equal(place, inside, out=place, casting='unsafe')
        place /= self._table.step
        inside -= self._cell
        powers[..., 1] = inside
        np.multiply(inside, inside, out=powers[..., 2])
        np.multiply(powers[..., 2], inside, out=powers[..., 3])
        np.multiply(powers[..., :3], _EXPONENTS, out=slopes[..., 1:])
        slopes *= place[:, :, None]
        pairs = (powers, powers), (slopes, powers), (powers, slopes)
        for kind, (across, around) in enumerate(pairs):
            np.multiply(across[:, 0, :, None], around[:, 1, None], out=self._products[:, kind])


def _unit(value: float, low: float, step: float, cells: int) -> tuple[float, int]:
    place = min(max((value - low) / step, 0.0), cells)
    cell = min(int(place), cells - 1)
    return place - cell, cell
