"""Where the controller planned to push the object, for the report's animation."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

POINTS = 12  # of each horizon; it is a smooth line
LONGEST_AGE_NS = 200_000_000  # an older one is no plan any more

Floats = NDArray[np.float64]
Nanoseconds = NDArray[np.int64]


@dataclass(frozen=True)
class Horizons:
    """The planned paths of a run, in order.

    Attributes:
        stamp: of the tick that planned each (m,) [ns], strictly increasing.
        points: of the object's centre (m, k, 2) [m].
    """

    stamp: Nanoseconds
    points: Floats

    @classmethod
    def of(cls, paths: Mapping[int, Floats]) -> 'Horizons':
        """Orders them.

        Args:
            paths: points (POINTS, 2) [m] by stamp [ns].
        """
        stamps = sorted(paths)
        points = np.array([paths[stamp] for stamp in stamps], np.float64)
        return cls(np.array(stamps, np.int64), points.reshape(-1, POINTS, 2))

    def at(self, stamps: Nanoseconds) -> Floats:
        """Points (n, k, 2) [m] of the last plans at some stamps (n,); NaN without one."""
        found = np.full((stamps.size, POINTS, 2), np.nan)
        if self.stamp.size:
            index = np.searchsorted(self.stamp, stamps, side='right') - 1
            age = stamps - self.stamp[index]
            fresh = (index >= 0) & (age <= LONGEST_AGE_NS)
            found[fresh] = self.points[index[fresh]]
        return found


def path(message: Any) -> Floats | None:
    """POINTS of a Horizon's (POINTS, 2) [m]; None where it has none."""
    count = min(len(message.x), len(message.y))
    if not count:
        return None
    chosen = np.linspace(0, count - 1, POINTS).round().astype(np.intp)
    return np.column_stack([np.asarray(each)[chosen] for each in (message.x, message.y)])
