"""Selection of the pushes that a model is trained on."""

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError
from push_core.data import HALF_FACE, PushSet, five_push_pattern
from push_core.geometry import Array

Rows = NDArray[np.intp]
SCALE = np.array([HALF_FACE, 1.0])
"""Distances between pushes are measured in half faces [m] and radians."""


def random_rows(pushes: PushSet, points: int, seed: int) -> Rows:
    """Row numbers of a random selection; each number of points is drawn independently.

    Raises:
        InputError: the set holds fewer pushes.
    """
    _check_points(pushes, points)
    return np.random.default_rng([seed, points]).permutation(len(pushes))[:points]


def nested_rows(pushes: PushSet, points: int, seed: int) -> Rows:
    """Row numbers of a random selection; smaller ones of the same seed are part of it.

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


def five_push_rows(pushes: PushSet) -> Rows:
    """Row numbers of the five pushes nearest to `five_push_pattern`.

    Raises:
        InputError: the set holds fewer than five pushes.
    """
    pattern = five_push_pattern(HALF_FACE)
    if len(pushes) < len(pattern):
        raise InputError(f'the pattern needs {len(pattern)} pushes, not {len(pushes)}')
    free = np.ones(len(pushes), dtype=bool)
    rows = []
    for place in pattern:
        gap = (pushes.inputs - place) / SCALE
        distance = np.where(free, np.sum(gap**2, axis=1), np.inf)
        rows.append(int(np.argmin(distance)))
        free[rows[-1]] = False
    return np.array(rows, dtype=np.intp)


def spread_rows(inputs: Array, most: int) -> Rows:
    """Row numbers of at most `most` inputs that are spread over the domain.

    The older of the two closest pushes is dropped until few enough remain: the domain stays
    covered, and of repeated pushes the newest one stays.

    Args:
        inputs: (n, 2) contact offsets [m] and directions [rad], oldest first.
        most: number of rows to keep.
    """
    scaled = inputs / SCALE
    kept = np.ones(len(scaled), dtype=bool)
    gaps, newer = np.full(len(scaled), np.inf), np.full(len(scaled), -1, dtype=np.intp)

    def find_nearest_newer(row: int) -> None:
        later = row + 1 + np.flatnonzero(kept[row + 1 :])
        squared = np.sum((scaled[later] - scaled[row]) ** 2, axis=1)
        gaps[row] = squared.min(initial=np.inf)
        newer[row] = int(later[np.argmin(squared)]) if later.size else -1

    if len(scaled) > most:
        for row in range(len(scaled)):
            find_nearest_newer(row)
    for _ in range(len(scaled) - most):
        dropped = int(np.argmin(gaps))
        kept[dropped], gaps[dropped] = False, np.inf
        for row in np.flatnonzero(kept & (newer == dropped)).tolist():
            find_nearest_newer(row)
    return np.flatnonzero(kept)


def _check_points(pushes: PushSet, points: int) -> None:
    if not 1 <= points <= len(pushes):
        raise InputError(f'cannot choose {points} of {len(pushes)} pushes')
