"""Asks a model until a table of it is exact enough: a conversation, whoever carries the questions.

The table's error is measured between its grid points against the model itself, in the model's own
standard deviations: an error much smaller than the model's doubt is none.
"""

from collections.abc import Generator
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from push_core.geometry import Array

from push_mpc.motion import travel_rates
from push_mpc.table.domain import Domain
from push_mpc.table.surrogate import Grid, Table

GRIDS = ((37, 61), (73, 121), (145, 241))
"""Points along p_y and along beta, coarse to fine."""

TOLERANCE = 0.05
"""Largest error of the table that ends the refinement, in standard deviations of the model."""

CHECKS = 256
MOST_AT_ONCE = 4096
"""Pushes in one question: so few that an answer does not hold up the 10 ms loop."""


@dataclass(frozen=True)
class Question:
    """A batch of pushes to ask the model about.

    Attributes:
        p_y: (n,) contact offsets [m].
        beta: (n,) push directions [rad].
        want_variance: whether its doubt is asked for too.
    """

    p_y: Array
    beta: Array
    want_variance: bool = False


@dataclass(frozen=True)
class Answer:
    """Of the model, per metre of travel.

    Attributes:
        mean: (n, 3) displacement rates [1, 1, rad/m].
        jacobian: (n, 3, 2) their derivatives by [p_y, beta].
        variance: (n, 3) of the rates, (0, 3) where nobody asked.
    """

    mean: Array
    jacobian: Array
    variance: Array

    @classmethod
    def of(cls, mean: Array, jacobian: Array, variance: Array, distance: float) -> 'Answer':
        """From what the model says of a push of a distance [m]."""
        return cls(*travel_rates(mean, jacobian, distance), variance / distance**2)


@dataclass(frozen=True)
class Tabulated:
    """A table and how good it is.

    Attributes:
        table: of the model.
        size: grid points along p_y and along beta.
        error: largest one found, in standard deviations of the model; NaN where it states none.
        data: what the model was trained on; elsewhere it guesses.
    """

    table: Table
    size: tuple[int, int]
    error: float
    data: Domain

    def __str__(self) -> str:
        size = f'{self.size[0]} x {self.size[1]} points'
        if np.isnan(self.error):
            return f'{size}; the model states no deviation to measure its error by'
        return f'{size}, error at most {self.error:.2g} standard deviations of the model'


Conversation: TypeAlias = Generator[Question, Answer, Tabulated]


@dataclass(frozen=True)
class Subject:
    """What has to be known of a model before it is asked.

    Attributes:
        data: what it was trained on.
        kind: gp or analytical; the analytical model states no variance.
        mean_function: zero or analytical: what it expects far from all data.
        side: of the square [m].
    """

    data: Domain
    kind: str
    mean_function: str
    side: float

    @property
    def asked(self) -> Domain:
        """Where the table holds; beyond it, its edge does.

        Far from the data a zero mean says that nothing moves, where the edge of the data is the
        better guess; the motion cone knows the whole face.
        """
        return self.data if self.mean_function == 'zero' else Domain.of_face(self.side)


def tabulation(subject: Subject) -> Conversation:
    """Refines a table until it is exact enough, or the finest grid is reached.

    The table of a model that states no variance is not refined.

    Raises:
        InputError: an answer is not finite.
    """
    checks = subject.asked.scattered(CHECKS)
    known = subject.kind == 'gp'
    truth = yield Question(*checks, want_variance=known)
    deviation = np.sqrt(np.maximum(truth.variance, np.finfo(float).tiny))
    for size in GRIDS:
        grid = subject.asked.grid(size)
        table = Table(grid, *(yield from _asked(grid)))
        if not known:
            return Tabulated(table, size, float('nan'), subject.data)
        error = float(np.max(np.abs(table.evaluate(*checks)[0] - truth.mean) / deviation))
        if error <= TOLERANCE:
            break
    return Tabulated(table, size, error, subject.data)


def _asked(grid: Grid) -> Generator[Question, Answer, tuple[Array, Array]]:
    """The answers at all points of a grid, a part at a time."""
    p_y, beta = grid.points()
    answers = []
    for first in range(0, p_y.size, MOST_AT_ONCE):
        part = slice(first, first + MOST_AT_ONCE)
        answers.append((yield Question(p_y[part], beta[part])))
    mean = np.concatenate([answer.mean for answer in answers])
    return mean, np.concatenate([answer.jacobian for answer in answers])
