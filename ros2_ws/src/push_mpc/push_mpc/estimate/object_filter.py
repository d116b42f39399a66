"""Kalman filter of the object's pose and of the model error.

The object is known badly, the tip well. State: the pose of the object [x, y, theta], and the model
error, a twist in the body frame per metre of tip travel. Between two poses the measured motion of
the tip moves the object as the model says, plus the model error, plus white noise. The model error
is a random walk over travelled length (a quasi-static push has no time scale). The ratio of the
two noises makes it an average over `length` where the camera is good; where it is bad, pose and
model error are averaged over more. All noise is measured (noise_estimate.py).
"""

import math

import numpy as np
from push_core.geometry import Array, wrap_angle
from push_core.physics import Slider

from push_mpc.estimate.noise_estimate import CameraNoise, MotionNoise
from push_mpc.table import Table

_CONTACT_GAP = 1e-3  # [m]; with a larger gap the tip does not push
_LONGEST_STEP = 1.2e-3  # [m] of tip travel in one step of the motion
_MOST_STEPS = 20
_FASTEST = 1.5  # [m/s]; a tip that was faster was placed, and did not push
_LEAST_TRAVEL = 5e-4  # [m] between two poses, for the noise: an object may move without the tip
_WHITE = np.array([3e-6, 3e-6, 3e-6 / 0.03**2])  # of the motion [m^2, m^2, rad^2] per metre
_LARGEST = np.array([0.4, 0.4, 12.0])  # model error
_GATE = 16.0  # squared Mahalanobis distance; noise alone exceeds it in one pose of 900
_SMALL, _SMALL_TURN = 1e-3, 0.0175  # [m], [rad]; a surprise within both is followed at once
_POSE, _RATE = slice(0, 3), slice(3, 6)


class ObjectFilter:
    """Estimates where the object is, and how its motion differs from the model's.

    Attributes:
        pose: estimated pose (3,) [m, m, rad] at the newest exposure.
        rate: model error (3,), body frame, per metre of tip travel [1, 1, rad/m].
        innovation: the newest measured pose minus its prediction (3,); NaN without one.
        deviation: standard deviation (3,) of the innovation that the filter expected.
        length: travel [m] over which a good camera's model error is averaged; see `change`.
    """

    def __init__(self, length: float, slider: Slider) -> None:
        """Starts without a pose.

        Args:
            length: travel [m] over which the model error is averaged; 0 keeps it at zero.
            slider: geometry of slider and tip.
        """
        self._slider = slider
        self._covariance = np.zeros((6, 6))
        self._transition = np.eye(6)
        self._density, self._usual_density = np.zeros((2, 3)), np.zeros((2, 3))
        self.reset()
        self.change(length)

    def reset(self) -> None:
        """Forgets pose, model error and noise."""
        self.pose, self.rate = np.zeros(3), np.zeros(3)
        self.innovation, self.deviation = np.full(3, math.nan), np.full(3, math.nan)
        self._camera, self._motion = CameraNoise(), MotionNoise()
        self._seen: tuple[Array, Array, float] | None = None
        self._turning = 0.0  # [rad/m]
        self._at_rest = self._surprises = 0
        self._covariance[:] = 0.0
        self._forget_rate()

    def change(self, length: float) -> None:
        """Averages the model error over another length [m]; 0 keeps it at zero."""
        self.length = length
        if not length:
            self.rate = np.zeros(3)
        self._usual_density[0] = _WHITE
        self._usual_density[1] = _WHITE / length**2 if length else 0.0
        self._forget_rate()

    def _forget_rate(self) -> None:
        """Knows the model error as well as after a long time."""
        np.multiply(self._usual_density, self._motion.factor, out=self._density)
        self._covariance[_RATE] = self._covariance[:, _RATE] = 0.0
        self._covariance[_RATE, _RATE] = np.diag(np.sqrt(self._density[0] * self._density[1]))

    @property
    def camera_variance(self) -> Array:
        """Variances (3,) of the measured pose [m^2, m^2, rad^2], as measured until now."""
        return self._camera.variance

    def settle(self, object_pose: Array, tip: Array, exposure: float) -> None:
        """Takes a measured pose (3,) of an object at rest, with the tip (2,) at rest as well."""
        if self._seen is not None:
            self._camera.at_rest(_difference(object_pose, self._seen[0]))
        self._seen = object_pose, tip, exposure
        self._at_rest += 1
        self.pose = self.pose + _difference(object_pose, self.pose) / self._at_rest
        self._covariance[_POSE, _POSE] = np.diag(self._camera.variance / self._at_rest)

    def observe(self, table: Table, object_pose: Array, tip: Array, exposure: float) -> None:
        """Takes a pose (3,) and tip position (2,) measured at an exposure [s]."""
        if self._seen is None:
            self.settle(object_pose, tip, exposure)
            return
        last_pose, last_tip, last_exposure = self._seen
        self._seen = object_pose, tip, exposure
        start = self.pose
        self._push(table, last_tip, tip, exposure - last_exposure)
        moved = _difference(self.pose, start)
        if self._corrected(object_pose):
            self._camera.pushed(_difference(object_pose, last_pose) - moved)
        else:
            self._camera.interrupted()

    def _corrected(self, object_pose: Array) -> bool:
        """Corrects the estimate by a measured pose; whether noise and a push explain the pose.

        What they do not explain is an outlier, or the object was moved: a large surprise counts
        only if the next pose is one as well.
        """
        error = self.innovation = _difference(object_pose, self.pose)
        expected = self._covariance[_POSE, _POSE] + np.diag(self._camera.variance)
        self.deviation = np.sqrt(expected.diagonal())
        inverse = np.linalg.inv(expected)
        gain = self._covariance[:, _POSE] @ inverse
        small = math.hypot(error[0], error[1]) < _SMALL and abs(error[2]) < _SMALL_TURN
        surprise = bool(error @ inverse @ error > _GATE)
        self._surprises = self._surprises + 1 if surprise else 0
        if not surprise:
            self.pose = self.pose + gain[_POSE] @ error
            self.pose[2] = wrap_angle(float(self.pose[2]))
            self._covariance -= gain @ self._covariance[_POSE]
        elif small or self._surprises > 1:
            self._place(object_pose)
        if surprise and not small:
            return False
        rate = self.rate + gain[_RATE] @ error
        self.rate = np.minimum(np.maximum(rate, -_LARGEST), _LARGEST)
        self._adapt(error / self.deviation)
        return True

    def _adapt(self, innovation: Array) -> None:
        """Adapts the noise of the motion, and with it what is known of the model error."""
        before = self._motion.factor.copy()
        self._motion.take(innovation)
        growth = np.sqrt(self._motion.factor / before)
        self._covariance[_RATE] *= growth[:, None]
        self._covariance[:, _RATE] *= growth
        np.multiply(self._usual_density, self._motion.factor, out=self._density)

    def _place(self, object_pose: Array) -> None:
        """Takes a measured pose (3,) for the estimate."""
        self.pose = object_pose.copy()
        self._covariance[_POSE] = self._covariance[:, _POSE] = 0.0
        self._covariance[_POSE, _POSE] = np.diag(self._camera.variance)

    def _push(self, table: Table, start: Array, end: Array, duration: float) -> None:
        """Moves the estimate with a tip that goes from a place (2,) to another in a time [s]."""
        length = math.hypot(*(end - start))
        steps = min(max(1, math.ceil(length / _LONGEST_STEP)), _MOST_STEPS)
        travel = 0.0
        if length <= _FASTEST * duration:
            move = (end - start) / steps
            for step in range(steps):
                travel += self._step(table, start + step * move, move)
        self._covariance.flat[::7] += max(travel, _LEAST_TRAVEL) * self._density.ravel()

    def _step(self, table: Table, tip: Array, move: Array) -> float:
        """Moves the estimate by one step of the tip (2,); its travel [m], 0 without contact."""
        middle = float(self.pose[2]) + 0.5 * self._turning * math.hypot(*move)
        cos, sin = math.cos(middle), math.sin(middle)
        along, aside = _turned(tip - self.pose[:2], cos, sin)
        v_n, v_t = _turned(move, cos, sin)
        if v_n <= 0.0 or self._slider.tip_x - along > _CONTACT_GAP:
            return 0.0
        travel = math.hypot(v_n, v_t)
        slopes = table.rate_and_slopes(aside, math.atan2(v_n, v_t))
        twist = slopes[:, 0, 0] + self.rate
        self._turning = float(twist[2])
        x, y, turn = (travel * twist).tolist()
        motion = np.array([cos * x - sin * y, sin * x + cos * y, turn])
        self.pose = self.pose + motion
        self._propagate(travel, cos, sin, along, slopes, motion)
        return travel

    def _propagate(
        self, travel: float, cos: float, sin: float, along: float, slopes: Array, motion: Array
    ) -> None:
        """Moves the covariance: the derivative of the motion by pose and model error."""
        by_pose = np.outer(slopes[:, 1, 0], (sin, -cos, -along))
        by_pose[:, 2] += slopes[:, 0, 1]
        turned = np.array(((cos, -sin, 0.0), (sin, cos, 0.0), (0.0, 0.0, 1.0))) * travel
        transition = self._transition
        transition[_POSE, _RATE] = turned
        np.matmul(turned, by_pose, out=transition[_POSE, _POSE])
        transition[0, 2] -= motion[1]
        transition[1, 2] += motion[0]
        transition.flat[:21:7] += 1.0
        self._covariance = transition @ self._covariance @ transition.T


def _turned(vector: Array, cos: float, sin: float) -> tuple[float, float]:
    """A world vector (2,) in the frame whose heading has this cosine and sine."""
    x, y = vector.tolist()
    return cos * x + sin * y, cos * y - sin * x


def _difference(pose: Array, other: Array) -> Array:
    """Difference (3,) of two poses, the angle wrapped."""
    change = pose - other
    change[2] = wrap_angle(float(change[2]))
    return np.asarray(change)
