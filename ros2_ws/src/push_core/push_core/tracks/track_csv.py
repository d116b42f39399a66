"""Tracks from CSV files of points."""

import math
import re
from pathlib import Path

import numpy as np

from push_core.common import InputError
from push_core.geometry import Array
from push_core.tracks.spline_track import SplineTrack
from push_core.tracks.track import Track

MAX_KNOTS = 800
SAME_PLACE = 1e-4  # [m] between two points that count as one
SHORTEST = 0.02  # [m]
FARTHEST = 1e6  # [m] from the origin; a file beyond it is in other units, or broken
_HEADING = re.compile(r'\s*x(_m| ?\[m\])?\s*,\s*y(_m| ?\[m\])?\s*', re.IGNORECASE)


def read_track(path: Path) -> Track:
    """Reads a smooth track through the points of a CSV file with two columns, x and y [m].

    A heading line is allowed. Very many points are resampled by arc length.

    Raises:
        InputError: names the file, and the line where there is one.
    """
    points = _distinct(_read_points(path))
    if len(points) < 4:
        raise InputError(
            f'{path}: a track needs at least 4 points that are {1e3 * SAME_PLACE:g} mm apart, '
            f'found {len(points)}'
        )
    track = SplineTrack(path.stem, _thinned(points))
    if track.length < SHORTEST:
        raise InputError(
            f'{path}: a track of {1e3 * track.length:.2g} mm is too short to be pushed; '
            'x and y are in metres'
        )
    return track


def _read_points(path: Path) -> Array:
    try:
        lines = path.read_text(encoding='utf-8-sig').splitlines()
    except OSError as error:
        raise InputError(f'{path}: {error.strerror}') from error
    except UnicodeDecodeError as error:
        raise InputError(f'{path}: not a text file') from error
    rows = []
    for number, text in enumerate(lines, start=1):
        if not text.strip() or (number == 1 and _is_heading(text, path)):
            continue
        rows.append(_point(text, f'{path}:{number}'))
    return np.array(rows).reshape(-1, 2)


def _is_heading(text: str, path: Path) -> bool:
    """Whether no field is a number; `nan` counts as one.

    Raises:
        InputError: the heading is not that of x and y in metres.
    """
    if any(map(_is_number, text.split(','))):
        return False
    if not _HEADING.fullmatch(text):
        raise InputError(f'{path}:1: the heading {text!r} is not x,y or x_m,y_m')
    return True


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _point(text: str, place: str) -> tuple[float, float]:
    try:
        x, y = (float(field) for field in text.split(','))
    except ValueError as error:
        raise InputError(f'{place}: expected two numbers x,y in metres, not {text!r}') from error
    if not (math.isfinite(x) and math.isfinite(y)):
        raise InputError(f'{place}: x and y must be finite, not {text!r}')
    if max(abs(x), abs(y)) > FARTHEST:
        raise InputError(f'{place}: {text!r} is beyond {FARTHEST:g} m; x and y are in metres')
    return x, y


def _distinct(points: Array) -> Array:
    """The points without repetitions of the previous one, which leave a spline no direction."""
    kept: list[Array] = []
    for point in points:
        if not kept or math.hypot(*(point - kept[-1])) >= SAME_PLACE:
            kept.append(point)
    if len(kept) > 1:
        kept[-1] = points[-1]  # a closed track ends exactly where it began
    return np.array(kept).reshape(-1, 2)


def _thinned(points: Array) -> Array:
    """At most MAX_KNOTS points, evenly spaced by arc length."""
    if len(points) <= MAX_KNOTS:
        return points
    s = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    even = np.linspace(0.0, s[-1], MAX_KNOTS)
    return np.stack([np.interp(even, s, points[:, axis]) for axis in range(2)], axis=-1)
