"""Which pushes of a set a model is trained on."""

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError
from push_core.data import HALF_FACE, PushSet, five_of_a_die

Rows = NDArray[np.intp]


def random_rows(pushes: PushSet, points: int, seed: int) -> Rows:
    """Row numbers of a random selection; each number of points is a draw of its own.

    Raises:
        InputError: the set holds fewer pushes.
    """
    _check_points(pushes, points)
    return np.random.default_rng([seed, points]).permutation(len(pushes))[:points]


def nested_rows(pushes: PushSet, points: int, seed: int) -> Rows:
    """Row numbers of a random selection that is part of any larger one of the same seed.

    Raises:
        InputError: the set holds fewer pushes.
    """
    _check_points(pushes, points)
    return np.random.default_rng(seed).permutation(len(pushes))[:points]


def subset_rows(pushes: PushSet, column: str) -> Rows:
    """Row numbers where a named selection is 1.

    Raises:
        InputError: there is no such selection, or it is empty.
    """
    if column not in pushes.subsets:
        known = ', '.join(pushes.subsets) or 'none'
        raise InputError(f'there is no subset {column!r}; the file has: {known}')
    rows = np.flatnonzero(pushes.subsets[column])
    if not rows.size:
        raise InputError(f'subset {column!r} is empty')
    return rows


def die_rows(pushes: PushSet) -> Rows:
    """Row numbers of the five pushes nearest to the five of a die.

    Raises:
        InputError: the set holds fewer than five pushes.
    """
    pattern = five_of_a_die(HALF_FACE)
    if len(pushes) < len(pattern):
        raise InputError(f'the five of a die needs {len(pattern)} pushes, not {len(pushes)}')
    free = np.ones(len(pushes), dtype=bool)
    rows = []
    for place in pattern:
        # half a face weighs as much as a radian
        gap = (pushes.inputs - place) / [HALF_FACE, 1.0]
        distance = np.where(free, np.sum(gap**2, axis=1), np.inf)
        rows.append(int(np.argmin(distance)))
        free[rows[-1]] = False
    return np.array(rows, dtype=np.intp)


def _check_points(pushes: PushSet, points: int) -> None:
    if not 1 <= points <= len(pushes):
        raise InputError(f'cannot choose {points} of {len(pushes)} pushes')
