"""Tracks: paths of the object's centre, with heading and curvature at every arc length.

`ArcTrack` is made of straight lines and circular arcs and is exact; `SplineTrack` runs smoothly
through given points.
"""

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from push_core.common import InputError
from push_core.geometry import Array

EIGHT_RADIUS = 0.15
SQUARE_RADIUS = 0.08
SQUARE_STRAIGHT = 0.24
LINE_LENGTH = 0.5
MAX_KNOTS = 800
SAME_PLACE = 1e-4  # [m] between two points of a file that count as one
SHORTEST = 0.02  # [m] of a track from a file
FARTHEST = 1e6  # [m] from the origin; beyond it a file is in other units, or broken
_HEADING = re.compile(r'\s*x(_m| ?\[m\])?\s*,\s*y(_m| ?\[m\])?\s*', re.IGNORECASE)


class Track(ABC):
    """A path by arc length s [m], 0 <= s <= length; closed ones go on for further laps.

    Attributes:
        name: what the user called it.
        length: arc length of one lap [m].
        closed: whether the end is the start.
        breakpoints: arc lengths in [0, length] where the curvature jumps, in order.
    """

    name: str
    length: float
    closed: bool
    breakpoints: Array

    def at(self, s: Array) -> tuple[Array, Array, Array, Array]:
        """Position x, y [m], heading [rad, continuous] and curvature [1/m] at arc lengths (n,)."""
        s = np.asarray(s, dtype=float)
        laps = np.floor(s / self.length) if self.closed else np.zeros_like(s)
        x, y, heading, curvature = self._within(s - laps * self.length)
        return x, y, heading + laps * self._turn(), curvature

    @abstractmethod
    def _within(self, s: Array) -> tuple[Array, Array, Array, Array]:
        """As `at`, for one lap."""

    def _turn(self) -> float:
        """Change of heading [rad] over one lap."""
        heading = self._within(np.array([0.0, self.length]))[2]
        return float(heading[1] - heading[0])


class ArcTrack(Track):
    """Lines and arcs joined without kinks."""

    def __init__(
        self, name: str, pieces: Sequence[tuple[float, float]], heading: float, closed: bool
    ) -> None:
        """Joins the pieces, starting at the origin.

        Args:
            name: what the user calls it.
            pieces: (length [m], curvature [1/m]) of each line or arc, in order.
            heading: direction of travel [rad] at the start.
            closed: whether the last piece ends where the first one begins.
        """
        lengths, curvatures = np.array(pieces, dtype=float).T
        self.name, self.closed = name, closed
        self.breakpoints = np.concatenate([[0.0], np.cumsum(lengths)])
        self.length = float(self.breakpoints[-1])
        self._curvature = curvatures
        turns = np.concatenate([[0.0], np.cumsum(lengths * curvatures)])
        self._heading = heading + turns
        starts = [np.zeros(2)]
        for index, length in enumerate(lengths):
            starts.append(starts[-1] + self._chord(np.array([index]), np.array([length]))[0])
        self._start = np.array(starts)

    def _chord(self, piece: Array, travelled: Array) -> Array:
        """Displacement (n, 2) after travelling (n,) along the pieces (n,)."""
        curvature, heading = self._curvature[piece], self._heading[piece]
        half_turn = 0.5 * curvature * travelled
        chord = travelled * np.sinc(half_turn / math.pi)
        direction = heading + half_turn
        unit = np.stack([np.cos(direction), np.sin(direction)], axis=-1)
        return np.asarray(chord[:, None] * unit)

    def _within(self, s: Array) -> tuple[Array, Array, Array, Array]:
        last = self._curvature.size - 1
        piece = np.clip(np.searchsorted(self.breakpoints, s, side='right') - 1, 0, last)
        travelled = s - self.breakpoints[piece]
        x, y = (self._start[piece] + self._chord(piece, travelled)).T
        heading = self._heading[piece] + self._curvature[piece] * travelled
        return x, y, heading, self._curvature[piece]


class SplineTrack(Track):
    """A cubic spline through points, by arc length."""

    _SAMPLES_PER_KNOT = 16

    def __init__(self, name: str, points: Array) -> None:
        """Runs through points (n, 2) [m]; closed if the last one repeats the first one."""
        span = float(np.sum(np.hypot(*np.diff(points, axis=0).T)))
        self.name = name
        self.closed = bool(np.hypot(*(points[-1] - points[0])) < 1e-6 * span)
        self._knots = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        self._points = points
        self._bend = _spline_bend(self._knots, points, self.closed)
        self.breakpoints = np.zeros(0)
        samples = self._SAMPLES_PER_KNOT * (self._knots.size - 1) + 1
        self._u = np.linspace(0.0, self._knots[-1], samples)
        middles = 0.5 * (self._u[1:] + self._u[:-1])
        speeds = np.hypot(*self._derivative(middles, 1).T)
        self._s = np.concatenate([[0.0], np.cumsum(speeds * np.diff(self._u))])
        self.length = float(self._s[-1])
        self._heading_at = np.unwrap(np.arctan2(*self._derivative(self._u, 1).T[::-1]))

    def _within(self, s: Array) -> tuple[Array, Array, Array, Array]:
        u = np.interp(s, self._s, self._u)
        x, y = self._derivative(u, 0).T
        (dx, dy), (ddx, ddy) = self._derivative(u, 1).T, self._derivative(u, 2).T
        rough = np.interp(s, self._s, self._heading_at)
        heading = np.arctan2(dy, dx)
        heading += 2.0 * math.pi * np.round((rough - heading) / (2.0 * math.pi))
        with np.errstate(invalid='ignore'):  # a cusp has no curvature: NaN
            curvature = (dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3
        return x, y, heading, curvature

    def _derivative(self, u: Array, order: int) -> Array:
        """Value or derivative (n, 2) of the spline at parameters (n,)."""
        index = np.clip(np.searchsorted(self._knots, u, side='right') - 1, 0, self._knots.size - 2)
        width = (self._knots[index + 1] - self._knots[index])[:, None]
        right = (u - self._knots[index])[:, None] / width
        left = 1.0 - right
        p0, p1 = self._points[index], self._points[index + 1]
        m0, m1 = self._bend[index], self._bend[index + 1]
        if order == 0:
            bend = (left**3 - left) * m0 + (right**3 - right) * m1
            return np.asarray(left * p0 + right * p1 + bend * width**2 / 6.0)
        if order == 1:
            bend = (1.0 - 3.0 * left**2) * m0 + (3.0 * right**2 - 1.0) * m1
            return np.asarray((p1 - p0) / width + bend * width / 6.0)
        return np.asarray(left * m0 + right * m1)


def _spline_bend(knots: Array, points: Array, closed: bool) -> Array:
    """Second derivatives (n, 2) at the knots: natural ends, or periodic if closed."""
    width = np.diff(knots)
    slope = np.diff(points, axis=0) / width[:, None]
    n = knots.size
    matrix, right = np.zeros((n, n)), np.zeros((n, 2))
    inner = np.arange(1, n - 1)
    matrix[inner, inner - 1] = width[:-1]
    matrix[inner, inner] = 2.0 * (width[:-1] + width[1:])
    matrix[inner, inner + 1] = width[1:]
    right[1:-1] = 6.0 * np.diff(slope, axis=0)
    if closed:
        matrix[0, [0, 1, n - 2]] = [2.0 * (width[0] + width[-1]), width[0], width[-1]]
        right[0] = 6.0 * (slope[0] - slope[-1])
        matrix[-1, [0, -1]] = [1.0, -1.0]
    else:
        matrix[0, 0] = matrix[-1, -1] = 1.0
    return np.asarray(np.linalg.solve(matrix, right))


def eight() -> Track:
    """The paper's 8-track: two circles of radius 150 mm that touch at the origin."""
    circle = 2.0 * math.pi * EIGHT_RADIUS
    pieces = [(circle, 1.0 / EIGHT_RADIUS), (circle, -1.0 / EIGHT_RADIUS)]
    return ArcTrack('eight', pieces, heading=math.pi / 2.0, closed=True)


def square() -> Track:
    """The paper's square: straight lines joined by quarter circles of radius 80 mm."""
    corner = (0.5 * math.pi * SQUARE_RADIUS, 1.0 / SQUARE_RADIUS)
    half_side = (0.5 * SQUARE_STRAIGHT, 0.0)
    pieces = [half_side, corner, half_side] * 4
    return ArcTrack('square', pieces, heading=0.0, closed=True)


def line() -> Track:
    """A straight line of half a metre about the origin's right."""
    return ArcTrack('line', [(LINE_LENGTH, 0.0)], heading=0.0, closed=False)


def circle() -> Track:
    """The left circle of the 8-track."""
    pieces = [(2.0 * math.pi * EIGHT_RADIUS, 1.0 / EIGHT_RADIUS)]
    return ArcTrack('circle', pieces, heading=math.pi / 2.0, closed=True)


TRACKS = {'eight': eight, 'square': square, 'line': line, 'circle': circle}


def by_name(name: str) -> Track:
    """The track of that name, or the one in the CSV file of that path.

    Raises:
        InputError: neither a known name nor a readable CSV file.
    """
    if name in TRACKS:
        return TRACKS[name]()
    if name.lower().endswith('.csv'):
        return from_csv(Path(name))
    raise InputError(f'unknown track {name!r}; use {", ".join(TRACKS)} or a .csv file of x, y')


def from_csv(path: Path) -> Track:
    """A smooth track through the points of a CSV file with two columns, x and y [m].

    A heading line is allowed. The points are resampled by arc length where there are very many.

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
    """Whether no field is a number, not even `nan`, which would be a fault.

    Raises:
        InputError: it is a heading of something else than x and y in metres.
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
    """Without points at the place of the one before, from where a spline could turn anywhere."""
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
