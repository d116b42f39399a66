"""Which pushes to keep where there may be only so many.

Of the two that lie closest together the older goes, until few enough are left: what is known of
the whole domain stays, and what was measured again is known by its newest measurement.
"""

import numpy as np
from push_core.data import HALF_FACE
from push_core.geometry import Array

from push_gp.models.sampling import Rows

SCALE = np.array([HALF_FACE, 1.0])
"""Half a face [m] counts as much as a radian."""

NOBODY = -1


def kept_rows(inputs: Array, most: int) -> Rows:
    """Row numbers, in order, of the (n, 2) inputs, oldest first, that are kept."""
    scaled = inputs / SCALE
    alive = np.ones(len(scaled), dtype=bool)
    gaps, newer = np.full(len(scaled), np.inf), np.full(len(scaled), NOBODY, dtype=np.intp)

    def look(row: int) -> None:
        """Finds the nearest newer push."""
        later = row + 1 + np.flatnonzero(alive[row + 1 :])
        squared = np.sum((scaled[later] - scaled[row]) ** 2, axis=1)
        gaps[row] = squared.min(initial=np.inf)
        newer[row] = int(later[np.argmin(squared)]) if later.size else NOBODY

    if len(scaled) > most:
        for row in range(len(scaled)):
            look(row)
    for _ in range(len(scaled) - most):
        dropped = int(np.argmin(gaps))
        alive[dropped], gaps[dropped] = False, np.inf
        for orphan in np.flatnonzero(alive & (newer == dropped)):
            look(int(orphan))
    return np.flatnonzero(alive)
