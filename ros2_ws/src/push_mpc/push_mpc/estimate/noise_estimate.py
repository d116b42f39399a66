"""Measures the noise of the camera, and how far the motion is from the model's, from the poses.

Camera: two poses in a row of an object at rest differ by twice the variance of the noise. While
the tip pushes, the motion that the model does not explain contains the difference of two noises,
too. Two such motions in a row share one pose, with opposite signs: the mean of their product is
minus the variance, whatever white noise the motion itself has (Mehra 1970).

Motion: a filter that assumes too little noise of the motion has innovations that follow one
another with the same sign, one that assumes too much has changing signs. Their average over some
poses shows both: it is larger or smaller than that of independent innovations.
"""

import math

import numpy as np
from push_core.geometry import Array

_PRIOR = np.array([0.05e-3, 0.05e-3, math.radians(0.008)]) ** 2  # of motion capture
_SMALLEST = np.array([0.01e-3, 0.01e-3, math.radians(0.002)]) ** 2
_LARGEST = np.array([5e-3, 5e-3, math.radians(5.0)]) ** 2
_MEMORY = 200  # poses
_HAND = 0.01  # [m] between two poses at rest; more is no noise

_SHARE = 0.1  # of a new innovation in the average
_OF_AVERAGE = (2.0 - _SHARE) / _SHARE  # inverse of the variance of the average
_PACE = 0.03  # change of the logarithm by an average with its variance doubled
_FARTHEST = 4.0  # standard deviations; more tell nothing else
_BOUNDS = math.log(0.1), math.log(1000.0)


class CameraNoise:
    """Variances of the measured x, y and heading; those of x and y are the same.

    Attributes:
        variance: (3,) [m^2, m^2, rad^2].
    """

    def __init__(self) -> None:
        """Starts from a good camera."""
        self.variance = _PRIOR.copy()
        self._mean = _PRIOR.copy()
        self._count = 1
        self._before: Array | None = None

    def at_rest(self, change: Array) -> None:
        """Takes the change (3,) from one pose of an object at rest to the next."""
        if math.hypot(change[0], change[1]) < _HAND:
            self._take(0.5 * change * change)

    def pushed(self, unexplained: Array) -> None:
        """Takes the part (3,) of such a change that the model does not explain."""
        if self._before is not None:
            self._take(-unexplained * self._before)
        self._before = unexplained

    def interrupted(self) -> None:
        """The next change does not follow the last one."""
        self._before = None

    def _take(self, sample: Array) -> None:
        sample[:2] = 0.5 * (sample[0] + sample[1])
        self._count = min(self._count + 1, _MEMORY)
        self._mean += (sample - self._mean) / self._count
        np.clip(self._mean, _SMALLEST, _LARGEST, out=self.variance)


class MotionNoise:
    """Factor on the noise of the motion that a filter assumes.

    Attributes:
        factor: (3,) of x, y and heading; those of x and y are the same.
    """

    def __init__(self) -> None:
        """Starts from one."""
        self.factor = np.ones(3)
        self._logarithm = np.zeros(3)
        self._average = np.zeros(3)

    def take(self, innovation: Array) -> None:
        """Takes an innovation (3,) as a multiple of its standard deviation."""
        near = np.minimum(np.maximum(innovation, -_FARTHEST), _FARTHEST)
        self._average += _SHARE * (near - self._average)
        excess = _OF_AVERAGE * self._average * self._average - 1.0
        excess[:2] = 0.5 * (excess[0] + excess[1])
        self._logarithm += _PACE * excess
        np.clip(self._logarithm, *_BOUNDS, out=self._logarithm)
        np.exp(self._logarithm, out=self.factor)
