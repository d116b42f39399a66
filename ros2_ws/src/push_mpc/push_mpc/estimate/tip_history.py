"""The last poses of the tip, of which that nearest in time to a pose of the object is used."""

from collections import deque
from typing import Generic, TypeVar

_LONGEST = 64  # poses; a quarter of a second of an arm that is read 250 times a second

Pose = TypeVar('Pose')


class TipHistory(Generic[Pose]):
    """Poses with stamps in rising order.

    Tip and object may be measured at rates of their own, and each with a delay of its own.
    """

    def __init__(self) -> None:
        """Starts empty."""
        self._poses: deque[tuple[int, Pose]] = deque(maxlen=_LONGEST)

    def add(self, stamp: int, pose: Pose) -> None:
        """Adds a pose with a stamp [ns].

        A stamp that is not after the last one forgets all before: a clock was set, the plant was
        reset, or the simulator repeats its last pose.
        """
        if self._poses and stamp <= self._poses[-1][0]:
            self._poses.clear()
        self._poses.append((stamp, pose))

    def clear(self) -> None:
        """Forgets all poses."""
        self._poses.clear()

    def nearest(self, stamp: int) -> tuple[int, Pose] | None:
        """Stamp [ns] and pose nearest to a stamp [ns]; of two as near the later. None if empty."""
        found = None
        for each in reversed(self._poses):
            if found is not None and abs(each[0] - stamp) >= abs(found[0] - stamp):
                break
            found = each
        return found
