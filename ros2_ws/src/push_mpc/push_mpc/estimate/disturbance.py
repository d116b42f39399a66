"""Estimates the model error: the difference between the object's measured twist and the model's.

Object and tip are both measured, so each tick yields a motion of the object under a known motion
of the tip. The part that the model does not predict, per metre of tip travel, passes a first-order
filter over travelled length (a quasi-static push has no time scale).
"""

import math

import numpy as np
from push_core.geometry import Array, wrap_angle
from push_core.physics import Slider

from push_mpc.table import Table

_CONTACT_GAP = 1e-3  # [m]; with a larger gap the tip does not push
_LEAST_TRAVEL = 1e-5  # [m]; a shorter travel is noise
_JUMP = 2e-3  # [m] in one tick; more is an outside disturbance, not a model error
_JUMP_ANGLE = 0.03  # [rad]
_LARGEST = np.array([0.4, 0.4, 12.0])


class DisturbanceEstimator:
    """First-order filter of the model error.

    Attributes:
        rate: error twist in the body frame per metre of travel (3,) [1, 1, rad/m].
        length: filter constant [m of travel]; 0 stops the estimation.
    """

    def __init__(self, length: float, slider: Slider) -> None:
        """Starts from zero.

        Args:
            length: filter constant [m of travel]; 0 keeps the estimate at zero.
            slider: geometry of slider and tip.
        """
        self.rate = np.zeros(3)
        self.length = length
        self._slider = slider
        self._seen: tuple[Array, Array] | None = None

    def reset(self) -> None:
        """Returns to zero."""
        self.rate = np.zeros(3)
        self._seen = None

    def observe(self, table: Table, object_pose: Array, tip: Array) -> None:
        """Updates the estimate with a measured object pose (3,) and tip position (2,)."""
        before, self._seen = self._seen, (object_pose, tip)
        if before is None or self.length == 0.0:
            return
        travel, unexplained = self._unexplained(table, *before, object_pose, tip)
        x, y, turn = unexplained
        if travel < _LEAST_TRAVEL or math.hypot(x, y) > _JUMP or abs(turn) > _JUMP_ANGLE:
            return
        share = 1.0 / max(self.length, travel)
        self.rate = np.clip(
            self.rate + share * (np.array(unexplained) - travel * self.rate), -_LARGEST, _LARGEST
        )

    def _unexplained(
        self, table: Table, pose: Array, tip: Array, next_pose: Array, next_tip: Array
    ) -> tuple[float, tuple[float, float, float]]:
        """Tip travel [m] (0 without contact) and the motion minus the model's (dx, dy, dtheta)."""
        turn = wrap_angle(float(next_pose[2] - pose[2]))
        heading = float(pose[2]) + 0.5 * turn
        cos, sin = math.cos(heading), math.sin(heading)
        along, aside = _turned(tip - pose[:2], cos, sin)
        v_n, v_t = _turned(next_tip - tip, cos, sin)
        if v_n <= 0.0 or self._slider.tip_x - along > _CONTACT_GAP:
            return 0.0, (0.0, 0.0, 0.0)
        travel = math.hypot(v_n, v_t)
        x, y = _turned(next_pose[:2] - pose[:2], cos, sin)
        dx, dy, dtheta = table.rate(aside, math.atan2(v_n, v_t))
        return travel, (x - travel * dx, y - travel * dy, turn - travel * dtheta)


def _turned(vector: Array, cos: float, sin: float) -> tuple[float, float]:
    """A world vector (2,) in the frame whose heading has this cosine and sine."""
    x, y = vector.tolist()
    return cos * x + sin * y, cos * y - sin * x
