"""Straight segments of a polyline, and signed distances to them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from push_bag.run import Floats

SHORTEST = 1e-30  # [m^2]; avoids a division by zero for a segment without length


@dataclass(frozen=True)
class Segments:
    """Segments (n,) of a path (n + 1, 2); the first and the last are half-lines.

    Attributes:
        x, y: start points [m].
        along_x, along_y: vectors from start to end [m].
        length_2: squared lengths [m^2].
        low, high: range of the position on the segment, in units of its length.
    """

    x: Floats
    y: Floats
    along_x: Floats
    along_y: Floats
    length_2: Floats
    low: Floats
    high: Floats

    @classmethod
    def of(cls, path: Floats) -> 'Segments':
        """The segments of a path (n + 1, 2)."""
        x, y = path[:-1].T.copy()
        along_x, along_y = np.diff(path, axis=0).T.copy()
        low, high = np.zeros(x.size), np.ones(x.size)
        # half-lines: a point before the start or after the end is no error across the path
        low[0], high[-1] = -np.inf, np.inf
        length_2 = np.maximum(along_x**2 + along_y**2, SHORTEST)
        return cls(x, y, along_x, along_y, length_2, low, high)

    def distance(self, index: NDArray[np.intp], points: Floats) -> Floats:
        """Distance (m,) of points (m, 2) to one segment each (m,), positive on the left."""
        along_x, along_y = self.along_x[index], self.along_y[index]
        to_x, to_y = points[:, 0] - self.x[index], points[:, 1] - self.y[index]
        share = (to_x * along_x + to_y * along_y) / self.length_2[index]
        np.clip(share, self.low[index], self.high[index], out=share)
        away = np.hypot(to_x - share * along_x, to_y - share * along_y)
        signed: Floats = np.copysign(away, along_x * to_y - along_y * to_x)
        return signed
