"""The tip under recorded velocity commands."""

import hashlib
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from push_core.geometry import Array


@dataclass(frozen=True)
class CommandedTip:
    """Commands and measured positions of the tip, world frame, on one clock.

    Attributes:
        name: of the recording.
        command_time: (k,) when each command was sent [s], not decreasing.
        command: (k, 2) velocity that was commanded then [m/s].
        time: (n,) when the tip was measured [s], increasing.
        tip: (n, 2) measured position [m].
    """

    name: str
    command_time: Array
    command: Array
    time: Array
    tip: Array

    def sha256(self) -> str:
        """Hash of all numbers."""
        digest = hashlib.sha256()
        for each in (self.command_time, self.command, self.time, self.tip):
            digest.update(np.ascontiguousarray(each).tobytes())
        return digest.hexdigest()

    def undisturbed(self, jump: float) -> 'CommandedTip':
        """The longest part in which the tip makes no step longer than `jump` [m]."""
        steps = np.hypot(*np.diff(self.tip, axis=0).T)
        edges = [0, *(np.flatnonzero(steps > jump) + 1).tolist(), len(self.tip)]
        first, after = max(pairwise(edges), key=lambda part: part[1] - part[0])
        time, tip = self.time[first:after], self.tip[first:after]
        return CommandedTip(self.name, self.command_time, self.command, time, tip)
