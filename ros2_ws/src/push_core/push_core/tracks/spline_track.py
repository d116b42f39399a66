"""Tracks through points: a cubic spline by arc length."""

import math

import numpy as np
from scipy.interpolate import CubicSpline

from push_core.geometry import Array
from push_core.tracks.track import Track

_SAMPLES_PER_KNOT = 16
_CLOSED = 1e-6
"""Largest distance of the ends of a closed track, over the sum of its chords."""


class SplineTrack(Track):
    """A cubic spline through points: natural, or periodic if closed."""

    def __init__(self, name: str, points: Array) -> None:
        """Runs through points (n, 2) [m]; closed if the last one repeats the first one."""
        chords = np.hypot(*np.diff(points, axis=0).T)
        self.name = name
        self.closed = bool(np.hypot(*(points[-1] - points[0])) < _CLOSED * chords.sum())
        self.breakpoints = np.zeros(0)
        knots = np.concatenate([[0.0], np.cumsum(chords)])
        if self.closed:
            points = np.vstack((points[:-1], points[:1]))
        self._spline = CubicSpline(
            knots, points, bc_type='periodic' if self.closed else 'natural', extrapolate=True
        )
        # arc length over the spline's parameter u, by the midpoint rule
        self._u = np.linspace(0.0, knots[-1], _SAMPLES_PER_KNOT * (knots.size - 1) + 1)
        middles = 0.5 * (self._u[1:] + self._u[:-1])
        speeds = np.hypot(*self._spline(middles, 1).T)
        self._s = np.concatenate([[0.0], np.cumsum(speeds * np.diff(self._u))])
        self.length = float(self._s[-1])
        self._heading_at = np.unwrap(np.arctan2(*self._spline(self._u, 1).T[::-1]))

    def _within(self, s: Array) -> tuple[Array, Array, Array, Array]:
        u = np.interp(s, self._s, self._u)
        (x, y), (dx, dy), (ddx, ddy) = (self._spline(u, order).T for order in range(3))
        heading = np.arctan2(dy, dx)
        continuous = np.interp(s, self._s, self._heading_at)
        heading += math.tau * np.round((continuous - heading) / math.tau)
        with np.errstate(invalid='ignore'):  # a cusp has no curvature: NaN
            curvature = (dx * ddy - dy * ddx) / np.hypot(dx, dy) ** 3
        return x, y, heading, curvature
