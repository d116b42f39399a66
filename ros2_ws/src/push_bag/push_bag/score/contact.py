"""Position of the tip relative to the pushed face.

From the recorded poses; that of the object is the true one where it was recorded, for noise would
look like losses of contact.

    gap = -side/2 - tip radius - x of the tip in the body frame (0 in contact),
    p_y = y of the tip in the body frame.
A contact loss is an interval during tracking in which the gap exceeds LOST_GAP.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import points_to_body

from push_bag.run import Floats, Nanoseconds, Reference, RunSeries
from push_bag.score.tracking import during_tracking

LOST_GAP = 0.5e-3  # [m]


@dataclass(frozen=True)
class Contact:
    """Gap and contact offset at each pose of the object with one of the tip near its time.

    Attributes:
        stamp: (n,) [ns].
        gap: (n,) [m] between tip and pushed face.
        p_y: (n,) contact offset [m].
    """

    stamp: Nanoseconds
    gap: Floats
    p_y: Floats


def contact(run: RunSeries, reference: Reference) -> Contact:
    """Gap and contact offset of a run during tracking."""
    known = run.truth if run.truth.stamp.size else run.object
    index, exists = run.pusher.near(known.stamp)
    used = exists & during_tracking(run, known.stamp)
    used &= np.isfinite(known.values).all(axis=1)
    if run.pusher.stamp.size:
        used &= np.isfinite(run.pusher.values[index]).all(axis=1)
    pose, tip = known.values[used], run.pusher.values[index[used]]
    x_body, y_body = points_to_body(pose, tip).T
    gap = -reference.side / 2.0 - reference.tip_radius - x_body
    return Contact(known.stamp[used], gap, y_body)


def loss_intervals(contact: Contact) -> list[tuple[int, int]]:
    """First and last stamp [ns] of each interval without contact."""
    lost: NDArray[np.bool_] = contact.gap > LOST_GAP
    edges = np.flatnonzero(np.diff(np.concatenate([[False], lost, [False]]).astype(np.int8)))
    return [
        (int(contact.stamp[first]), int(contact.stamp[after - 1]))
        for first, after in edges.reshape(-1, 2)
    ]
