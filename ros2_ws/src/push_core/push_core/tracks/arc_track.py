"""Tracks of straight lines and circular arcs, exact at every arc length."""

import math
from collections.abc import Sequence

import numpy as np

from push_core.geometry import Array
from push_core.tracks.track import Track


class ArcTrack(Track):
    """Lines and arcs joined without kinks."""

    def __init__(
        self, name: str, pieces: Sequence[tuple[float, float]], heading: float, closed: bool
    ) -> None:
        """Joins the pieces, starting at the origin.

        Args:
            name: as given by the user.
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
