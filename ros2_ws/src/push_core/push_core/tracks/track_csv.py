"""Tracks from CSV files of points."""

import math
import sys
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from push_core.common import CsvText, InputError, number_of, read_csv_text
from push_core.geometry import Array
from push_core.tracks.spline_track import SplineTrack
from push_core.tracks.track import Track

MAX_KNOTS = 800
SAME_PLACE = 1e-4  # [m] between two points that count as one
SHORTEST = 0.02  # [m]
FARTHEST = 1e6  # [m] from the origin; a file beyond it is in other units, or broken
X_NAMES = ('x', 'x_m', 'x [m]', 'x[m]', 'x (m)', 'x(m)', 'pos_x', 'position_x', 'px')
Y_NAMES = tuple(name.replace('x', 'y') for name in X_NAMES)
CLOSING_GAP = 2e-3  # [m] of the last point from the first one, at which a track is closed
_ROUNDING = 1e-6  # [m]
_CLOSING_SHARE = 0.1  # the same, as a share of the distance of two points
_MANY = 60  # points, which describe a curve
_SPLINE_LEAVES = 5e-3  # [m] from the straight lines between the points, without a word


def read_track(path: Path) -> Track:
    """Reads a smooth track through the points of a CSV file with columns x and y [m].

    A line of names may say which columns these are; without one they are the first two. Very many
    points are resampled by arc length. What is read otherwise than it stands there is told on
    standard error.

    Raises:
        InputError: names the file, and the line where there is one.
    """
    points = _closed(_distinct(_read_points(path)), path)
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
    _tell_of_corners(track, points)
    return track


def _closed(points: Array, path: Path) -> Array:
    """The points, with the first one at the end where the last one all but repeats it."""
    if len(points) < 4:
        return points
    gap = math.hypot(*(points[-1] - points[0]))
    spacing = float(np.median(np.hypot(*np.diff(points, axis=0).T)))
    if not 0.0 < gap <= min(CLOSING_GAP, _CLOSING_SHARE * spacing):
        return points
    if gap > _ROUNDING:
        sys.stderr.write(
            f'track {path.stem}: its end is {1e3 * gap:.2g} mm from its start, so it is closed\n'
        )
    return np.vstack([points[:-1], points[:1]])


def _tell_of_corners(track: SplineTrack, points: Array) -> None:
    """Says how far the track leaves the straight lines between few points."""
    if len(points) > _MANY:
        return
    x, y, _, _ = track.at(np.linspace(0.0, track.length, 50 * len(points)))
    places = np.column_stack([x, y])
    aside = float(np.min([_distances(places, *ends) for ends in pairwise(points)], axis=0).max())
    if aside > _SPLINE_LEAVES:
        sys.stderr.write(
            f'track {track.name}: a smooth curve through its {len(points)} points, up to '
            f'{1e3 * aside:.0f} mm off the straight lines between them; if these are meant, put '
            'points on them every 10 mm\n'
        )


def _distances(places: Array, start: Array, end: Array) -> Array:
    """Distance (n,) of places (n, 2) to the straight line from a start to an end (2,)."""
    along = end - start
    share = np.clip((places - start) @ along / (along @ along), 0.0, 1.0)
    return np.asarray(np.hypot(*(places - start - share[:, None] * along).T))


def _read_points(path: Path) -> Array:
    text = read_csv_text(path, (*X_NAMES, *Y_NAMES), at_least=2)
    columns = _columns(text)
    width = len(text.names or (text.rows[0][1] if text.rows else ()))
    rows = [_point(cells, width, columns, f'{path}:{number}') for number, cells in text.rows]
    points = np.array(rows).reshape(-1, 2)
    _check_first_column(text, points)
    return points


def _columns(text: CsvText) -> tuple[int, int]:
    """Places of x and y: by name, or else the first two.

    Raises:
        InputError: the names are others.
    """
    if not text.names:
        return 0, 1
    names = ','.join(text.names)
    x, y = (
        [place for place, name in enumerate(text.names) if name in known]
        for known in (X_NAMES, Y_NAMES)
    )
    if len(x) != 1 or len(y) != 1 or x > y:
        in_mm = '; divide millimetres by 1000' if 'mm' in names else ''
        raise InputError(
            f'{text.path}:{text.names_line}: the heading {names!r} is not x,y or x_m,y_m{in_mm}'
        )
    return x[0], y[0]


def _point(
    cells: Sequence[str], width: int, columns: tuple[int, int], place: str
) -> tuple[float, float]:
    row = ','.join(cells)
    try:
        if width < 2 or len(cells) < width or any(cells[width:]):
            raise ValueError(row)
        x, y = (number_of(cells[column]) for column in columns)
    except ValueError as error:
        raise InputError(f'{place}: expected two numbers x,y in metres, not {row!r}') from error
    if not (math.isfinite(x) and math.isfinite(y)):
        raise InputError(f'{place}: x and y must be finite, not {row!r}')
    if max(abs(x), abs(y)) > FARTHEST:
        raise InputError(f'{place}: {row!r} is beyond {FARTHEST:g} m; x and y are in metres')
    return x, y


def _check_first_column(text: CsvText, points: Array) -> None:
    """Refuses a file of several columns without names whose first one counts its rows."""
    several = len(points) > 1 and not text.names and len(text.rows[0][1]) > 2
    if several and np.array_equal(np.diff(points[:, 0]), np.ones(len(points) - 1)):
        raise InputError(
            f'{text.path}: the first of its columns counts the rows; name the columns in the '
            'first line, x and y among them'
        )


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
