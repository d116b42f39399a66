"""The numbers of the quadratic program at every sample of a plan, as the solver wants them.

Made once for each plan and model, so that a tick only copies its window. The solver sees
millimetres, centimetres per second and hundredths of a radian.
"""

from dataclasses import dataclass

import numpy as np
from push_core.frames import Array

NX, NU = 4, 2
STATE_SCALE = np.array([1e-3, 1e-3, 1e-2, 1e-3])
INPUT_SCALE = np.array([1e-2, 1e-2])
_LIMITED_SCALE = np.array([STATE_SCALE[3], *INPUT_SCALE])
# where a transition can differ from 0: the world position enters no rate
A_PATTERN = np.array([[1, 0, 1, 1], [0, 1, 1, 1], [0, 0, 1, 1], [0, 0, 0, 1]], dtype=bool)
ENTRIES = int(A_PATTERN.sum()) + NX * NU


@dataclass(frozen=True)
class Stages:
    """Stages of the horizon, one for each sample at which it can have one; all scaled.

    Attributes:
        entries: of -A by pattern, then of -B (n, ENTRIES).
        drift: how the nominal itself misses the model's motion (n, 4).
        low: lowest deviation of p_y after the stage, of v_n and of v_t in it (n, 3).
        high: highest ones (n, 3).
    """

    entries: Array
    drift: Array
    low: Array
    high: Array

    @classmethod
    def of(
        cls, transition: Array, effect: Array, drift: Array, limits: tuple[Array, Array]
    ) -> 'Stages':
        """Scales the stages.

        Args:
            transition: A (n, 4, 4).
            effect: B (n, 4, 2).
            drift: c (n, 4).
            limits: lowest and highest deviation of [p_y m, v_n m/s, v_t m/s], each (n, 3).
        """
        a = transition * (STATE_SCALE / STATE_SCALE[:, None])
        b = effect * (INPUT_SCALE / STATE_SCALE[:, None])
        entries = np.concatenate([a[:, A_PATTERN], b.reshape(-1, NX * NU)], axis=-1)
        low, high = (np.asarray(limit / _LIMITED_SCALE) for limit in limits)
        return cls(-entries, drift / STATE_SCALE, low, high)

    def __len__(self) -> int:
        return len(self.entries)

    def in_si_units(self, window: Array) -> tuple[Array, Array, Array, tuple[Array, Array]]:
        """What `of` was given, for the stages (N,) of a window."""
        count = ENTRIES - NX * NU
        transition = np.zeros((len(window), NX, NX))
        transition[:, A_PATTERN] = -self.entries[window, :count]
        effect = -self.entries[window, count:].reshape(-1, NX, NU)
        return (
            transition * (STATE_SCALE[:, None] / STATE_SCALE),
            effect * (STATE_SCALE[:, None] / INPUT_SCALE),
            self.drift[window] * STATE_SCALE,
            (self.low[window] * _LIMITED_SCALE, self.high[window] * _LIMITED_SCALE),
        )
