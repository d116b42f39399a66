"""Iterative learning of the reference: each lap shifts it against the error of the last one.

What recurs in every lap at the same place, such as friction that varies over the table, needs no
model. Source: Bristow, Tharayil and Alleyne 2006, with a zero-phase filter over the path.
"""

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import Array

from push_gp.learn.smoothing import PoseNoise
from push_gp.learn.timed_reference import TimedReference

GAIN = 0.6
"""Largest share of the last error that the next lap is shifted by."""

WANDERED = 4.5e-3
"""Path [m] over which the mean of the camera's noise is what the object wanders by: noise moves
the object through the controller, differently in each lap."""

SMOOTHED = 0.02
"""Length of path [m] over which the error is averaged (half the width of a Hann window)."""

FASTEST = 1.5e-3
"""Largest step [m] of the shift from one lap to the next: larger ones disturb a sliding tip."""

LARGEST = 0.01
"""Largest shift of the reference [m] along each axis."""

_LEAST = 0.05  # share of the window that must have been measured for a place to learn


class ReferenceShift:
    """Learns a shift of the reference over one lap.

    Attributes:
        shift: (n, 2) [m] at every sample of the lap, in the frame of the start.
        gain: share of the next error that it shifts against.
    """

    def __init__(self, reference: TimedReference) -> None:
        """Starts from none."""
        self._lap = reference.lap_time
        self.shift, self.gain = np.zeros((reference.samples, 2)), GAIN
        half = max(1, round(SMOOTHED / reference.speed / reference.period))
        self._window = np.hanning(2 * half + 3)[1:-1]

    def start_from(self, shift: Array) -> None:
        """Goes on from another shift (n, 2), or from none (0, 2)."""
        self.shift = self._whole(shift)

    def trust(self, errors: Array, noise: PoseNoise) -> None:
        """Sets the gain to `GAIN` times the share of the squared errors that can recur.

        Source: James and Stein 1961; the rest is the camera's noise and what the object wanders
        by because of it.

        Args:
            errors: (m, 2) of the next lap [m].
            noise: of the camera in it.
        """
        white = 2.0 * noise.position**2
        moved = float(np.mean(np.sum(errors**2, axis=1))) - white if len(errors) else 0.0
        wandered = white * noise.spacing / WANDERED
        self.gain = GAIN * max(0.0, 1.0 - wandered / moved) if moved > 0.0 else 0.0

    def driven_by(self, shift: Array, times: Array) -> Array:
        """What to add to errors (m, 2) at times (m,) of the reference under another shift (n, 2).

        With it `learn` shifts those places from that shift on; (0, 2) is none.
        """
        before = (self.shift - self._whole(shift))[self._rows(times)]
        return before / self.gain if self.gain else np.zeros_like(before)

    def learn(self, times: Array, errors: Array) -> None:
        """Shifts the reference against the errors of a lap; places without one learn nothing.

        Args:
            times: (m,) of the reference [s].
            errors: (m, 2) of the object's position at these times [m], in the frame of the start.
        """
        errors, known = self._binned(times, errors)
        seen = self._smooth(known)
        mean = self._smooth(errors) / np.maximum(seen, _LEAST)
        taught = np.minimum(seen / _LEAST, 1.0)
        step = self.gain * taught * mean
        step *= FASTEST / np.maximum(np.hypot(*step.T), FASTEST)[:, None]
        self.shift = np.clip(self.shift - step, -LARGEST, LARGEST)

    def _whole(self, shift: Array) -> Array:
        return shift if len(shift) else np.zeros_like(self.shift)

    def _binned(self, times: Array, errors: Array) -> tuple[Array, Array]:
        """Sums of the errors (n, 2) and number of them (n, 1) at every sample of the lap."""
        sums, counts = np.zeros_like(self.shift), np.zeros((len(self.shift), 1))
        rows = self._rows(times)
        np.add.at(sums, rows, errors)
        np.add.at(counts, rows, 1.0)
        return sums, counts

    def _rows(self, times: Array) -> NDArray[np.intp]:
        """The sample of the lap at each time (m,) [s]."""
        return (times / self._lap * len(self.shift)).astype(np.intp) % len(self.shift)

    def _smooth(self, values: Array) -> Array:
        """Averages (n, k) over the window; the lap is closed."""
        share = self._window / self._window.sum()
        half = len(share) // 2
        rows = np.arange(-half, len(values) + half) % len(values)
        columns = [np.convolve(column, share, 'valid') for column in values[rows].T]
        return np.stack(columns, axis=-1)
