"""The plan of the last tick, shifted to the present one: where the next QP is linearised."""

import numpy as np
from push_core.geometry import Array


class LastPlan:
    """Deviations from the nominal over the horizon.

    Attributes:
        states: deviations of the states (N + 1, 4) [m, m, rad, m].
        inputs: deviations of the inputs (N, m).
    """

    def __init__(self, steps: int, inputs: int) -> None:
        """Starts on the nominal."""
        self.states, self.inputs = np.zeros((steps + 1, 4)), np.zeros((steps, inputs))
        self._found = np.zeros((steps + 1, 4)), np.zeros((steps, inputs))
        self._changes = np.zeros((steps, 4)), np.zeros((steps - 1, inputs))
        self._sample = 0
        self._found_at: int | None = None

    def keep(self, states: Array, inputs: Array) -> None:
        """Takes the plan that was found for the horizon of the latest shift."""
        self._found[0][:] = states
        self._found[1][:] = inputs
        self._found_at = self._sample

    def forget(self) -> None:
        """Returns to the nominal at the next shift."""
        self._found_at = None

    def shift(self, sample: int, stride: int) -> None:
        """Shifts the plan found last to a horizon that begins at a sample of the nominal.

        Between two stages the deviations are interpolated; the last ones stay. A horizon that does
        not begin within that of the plan is on the nominal.
        """
        self._sample = sample
        steps = len(self.inputs)
        ahead = -stride if self._found_at is None else sample - self._found_at
        if not -stride < ahead < steps * stride:
            self.states[:] = self.inputs[:] = 0.0
            return
        whole, rest = divmod(max(ahead, 0), stride)
        parts = zip((self.states, self.inputs), self._found, self._changes, strict=True)
        for values, found, change in parts:
            values[: len(values) - whole] = found[whole:]
            values[len(values) - whole :] = found[-1]
            np.subtract(values[1:], values[:-1], out=change)
            np.multiply(change, rest / stride, out=change)
            values[:-1] += change
