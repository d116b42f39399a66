"""Planned paths of the object, for the report's animation.

The score does not use them, so they are decoded only when they are drawn.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from push_core.common import InputError
from push_node.stamps import to_nanoseconds

from push_bag.file import Record

POINTS = 6  # of each horizon: 17 mm apart on the 8-track, chords within 0.2 mm of the curve
LONGEST_AGE_NS = 200_000_000  # an older horizon is not shown


@dataclass(frozen=True)
class Horizons:
    """The planned paths of a run, in order of time.

    Attributes:
        stamp: of the tick that planned each (m,) [ns], strictly increasing.
        points: of the object's centre (m, POINTS, 2) [m].
    """

    stamp: NDArray[np.int64]
    points: NDArray[np.float64]

    @classmethod
    def of(cls, records: Iterable[Record]) -> 'Horizons':
        """Decodes Horizon messages; of messages with equal stamps the last one counts.

        Raises:
            InputError: one is not a Horizon.
        """
        messages = {to_nanoseconds(each.header.stamp): each for each in map(_message, records)}
        stamps = sorted(stamp for stamp, message in messages.items() if len(message.x))
        points = np.array([_points(messages[stamp]) for stamp in stamps], np.float64)
        return cls(np.array(stamps, np.int64), points.reshape(-1, POINTS, 2))

    def at(self, stamps: NDArray[np.int64]) -> NDArray[np.float64]:
        """Points (n, POINTS, 2) [m] of the latest horizons at stamps (n,); NaN without one."""
        points = np.full((stamps.size, POINTS, 2), np.nan)
        if self.stamp.size:
            index = np.searchsorted(self.stamp, stamps, side='right') - 1
            age = stamps - self.stamp[index]
            fresh = (index >= 0) & (age <= LONGEST_AGE_NS)
            points[fresh] = self.points[index[fresh]]
        return points


def _message(record: Record) -> Any:
    message = record.message()
    if len(message.x) != len(message.y):
        raise InputError(f'a message on {record.topic.name} has x and y of different lengths')
    return message


def _points(message: Any) -> NDArray[np.float64]:
    chosen = np.linspace(0, len(message.x) - 1, POINTS).round().astype(np.intp)
    return np.column_stack([np.asarray(each)[chosen] for each in (message.x, message.y)])
