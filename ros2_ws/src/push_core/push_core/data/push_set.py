"""A set of short straight pushes: contact offset, push direction, displacement of the object."""

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from push_core.common import InputError
from push_core.geometry import Array

HALF_FACE = 0.045
"""Half the length of the pushed face [m]."""

P_Y_LIMIT = HALF_FACE + 0.005
"""Largest contact offset of any push or query [m]: the face and a margin for its corner."""

COPY_TOLERANCE = 1e-6  # [m], [rad]

LARGEST_DISPLACEMENT = np.array([1.0, 1.0, math.pi])
"""Larger displacements [m, m, rad] are refused: the file is in millimetres or degrees."""


@dataclass(frozen=True)
class PushSet:
    """Pushes of one distance, in the body frame at the start of each.

    Attributes:
        p_y: (n,) contact offsets along the pushed face [m].
        beta: (n,) push directions atan2(v_n, v_t) [rad]; pi/2 is the inward normal (+x).
        displacement: (n, 3) motion dx_b [m], dy_b [m], dtheta [rad] of the object.
        distance: travel of the pusher in each push [m].
        subsets: named selections, each (n,) of bool.

    Raises:
        InputError: lengths differ, or a value is not finite or out of its domain.
    """

    p_y: Array
    beta: Array
    displacement: Array
    distance: float
    subsets: Mapping[str, NDArray[np.bool_]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ('p_y', 'beta', 'displacement'):
            object.__setattr__(self, name, _frozen(getattr(self, name)))
        count = self.p_y.size
        if (
            self.p_y.shape != (count,)
            or self.beta.shape != (count,)
            or self.displacement.shape != (count, 3)
        ):
            raise InputError(
                f'a push set needs n offsets, n directions and n x 3 displacements, '
                f'not {self.p_y.shape}, {self.beta.shape} and {self.displacement.shape}'
            )
        check_distance(self.distance)
        found = push_fault(self.p_y, self.beta, self.displacement)
        if found:
            raise InputError(f'push {found[0]}: {found[1]}')

    def __len__(self) -> int:
        return self.p_y.size

    @property
    def inputs(self) -> Array:
        """(n, 2) inputs p_y [m] and beta [rad]."""
        return np.column_stack((self.p_y, self.beta))

    def take(self, rows: NDArray[np.intp]) -> 'PushSet':
        """The pushes of the given row numbers, in their order."""
        subsets = {name: member[rows] for name, member in self.subsets.items()}
        return PushSet(
            self.p_y[rows], self.beta[rows], self.displacement[rows], self.distance, subsets
        )

    def without_copies(self) -> 'PushSet':
        """The set with rows that agree in all numbers, to 1e-6, counted once.

        Measurements are noisy, so that equal ones are copies: of a file joined to itself, or of a
        log that was written twice.
        """
        numbers = np.column_stack((self.inputs, self.displacement))
        _, rows = np.unique(np.round(numbers / COPY_TOLERANCE), axis=0, return_index=True)
        return self if rows.size == len(self) else self.take(np.sort(rows))

    def joined(self, other: 'PushSet') -> 'PushSet':
        """These pushes followed by the others; named selections are dropped.

        Raises:
            InputError: the others cover another distance.
        """
        if other.distance != self.distance:
            raise InputError(
                f'pushes of {other.distance * 1e3:g} mm do not join pushes of '
                f'{self.distance * 1e3:g} mm'
            )
        return PushSet(
            np.concatenate((self.p_y, other.p_y)),
            np.concatenate((self.beta, other.beta)),
            np.concatenate((self.displacement, other.displacement)),
            self.distance,
        )

    def sha256(self) -> str:
        """Hash of all values; file names and selections do not enter."""
        digest = hashlib.sha256()
        for values in (self.p_y, self.beta, self.displacement, np.array([self.distance])):
            digest.update(np.ascontiguousarray(values, '<f8').tobytes())
        return digest.hexdigest()


FIVE_PUSHES = np.array([[0.0, 0.0], [-0.5, -30.0], [0.5, -30.0], [-0.5, 30.0], [0.5, 30.0]])
"""(5, 2) contact offsets [half faces] and angles to the normal [deg]."""


def five_push_pattern(half_face: float) -> Array:
    """The smallest training set of the paper, in the pattern of the five of a die.

    One push at the middle of the face along its normal, and four half-way to its ends, 30 degrees
    to either side. Source: Bauza, Hogan and Rodriguez 2018, section 6.

    Args:
        half_face: half the length of the pushed face [m].

    Returns:
        (5, 2) contact offsets p_y [m] and directions beta [rad].
    """
    return np.asarray(FIVE_PUSHES * [half_face, math.radians(1.0)] + [0.0, math.pi / 2.0])


def input_fault(p_y: Array, beta: Array) -> tuple[int, str] | None:
    """The first push that is out of the range of every model.

    Args:
        p_y: (n,) contact offsets [m].
        beta: (n,) push directions [rad].

    Returns:
        Its row and a description of the fault; None if there is none.
    """
    # comparisons are written so that NaN fails them
    good = (np.abs(p_y) <= P_Y_LIMIT) & (beta > 0) & (beta < math.pi)
    if good.all():
        return None
    row = int(np.argmin(good))
    return row, _describe_input(float(p_y[row]), float(beta[row]))


def _describe_input(p_y: float, beta: float) -> str:
    if not math.isfinite(p_y) or not math.isfinite(beta):
        return f'p_y = {p_y:g}, beta = {beta:g} is not finite'
    if abs(p_y) > P_Y_LIMIT:
        return f'p_y is {p_y:g} m, must be within {P_Y_LIMIT:g} m of the middle of the face'
    return f'beta is {beta:g} rad, must be between 0 and pi; pi/2 is the inward normal'


def push_fault(p_y: Array, beta: Array, displacement: Array) -> tuple[int, str] | None:
    """The first push that is not valid.

    Args:
        p_y: (n,) contact offsets [m].
        beta: (n,) push directions [rad].
        displacement: (n, 3) motion of the object [m, m, rad].

    Returns:
        Its row and a description of the fault; None if there is none.
    """
    return input_fault(p_y, beta) or _displacement_fault(displacement)


def _displacement_fault(displacement: Array) -> tuple[int, str] | None:
    good = (np.abs(displacement) <= LARGEST_DISPLACEMENT).all(axis=1)
    if good.all():
        return None
    row = int(np.argmin(good))
    dx, dy, dtheta = displacement[row]
    return row, f'no push moves the object by {dx:g} m, {dy:g} m and {dtheta:g} rad'


def check_distance(distance: float) -> None:
    """Checks the travel of the pusher in one push.

    Raises:
        InputError: it is not finite, not positive, or 1 m or more.
    """
    if not 0 < distance < 1:
        raise InputError(f'the distance of a push is {distance:g} m, must be between 0 and 1 m')


def _frozen(values: ArrayLike) -> Array:
    array = np.array(values, dtype=np.float64)
    array.setflags(write=False)
    return array
