"""The delay predictor: the state at the instant at which the next command will act.

The measured state is rolled forward through the commands already sent, with the model of the
object and the model of the robot's lag (a Smith predictor for a nonlinear plant).
"""

import math

import numpy as np
from push_core.actuator import Actuator, ActuatorSettings
from push_core.frames import Array
from push_core.slider import Slider

from push_mpc.surrogate import Table

_STEP = 0.01
_CONTACT_GAP = 5e-4


class Predictor:
    """Keeps a copy of the robot, fed with the same commands, and looks ahead with it."""

    def __init__(self, settings: ActuatorSettings, slider: Slider) -> None:
        self._slider = slider
        self._now = Actuator(settings)
        self._ahead = Actuator(settings)
        self._time = -math.inf
        self._horizon = settings.dead_time + settings.lag

    @property
    def horizon(self) -> float:
        """Time [s] from a command to its effect: dead time plus lag."""
        return self._horizon

    def reset(self) -> None:
        """Forgets all commands: the robot is at rest."""
        self._now.reset()
        self._time = -math.inf

    def sent(self, velocity: Array, time: float) -> None:
        """Takes note of a command (2,) [m/s] that was sent at a time [s]."""
        self._now.command(velocity, time)

    def predict(
        self, table: Table, object_pose: Array, tip: Array, exposure: float, until: float
    ) -> tuple[Array, Array]:
        """Object pose (3,) and tip position (2,) at a later time.

        Args:
            table: model of the object.
            object_pose: measured pose (3,) at the exposure.
            tip: measured tip position (2,) at the exposure.
            exposure: time of the measurement [s], not before the last one.
            until: the later time [s].
        """
        self._follow(exposure)
        self._ahead.copy_state(self._now)
        pose, tip, time = np.array(object_pose), np.array(tip), exposure
        while until - time > 1e-6:
            duration = min(_STEP, until - time)
            velocity = self._ahead.advance(time, duration)
            pose = self._pushed(table, pose, tip, velocity, duration)
            tip = tip + velocity * duration
            time += duration
        return pose, tip

    def _follow(self, exposure: float) -> None:
        """Lets the copy of the robot live up to the exposure."""
        if self._time == -math.inf:
            self._time = exposure
        while exposure - self._time > 1e-6:
            duration = min(_STEP, exposure - self._time)
            self._now.advance(self._time, duration)
            self._time += duration

    def _pushed(
        self, table: Table, pose: Array, tip: Array, velocity: Array, duration: float
    ) -> Array:
        """The object's pose after the tip moved on; it rests where the tip does not press."""
        cos, sin = math.cos(pose[2]), math.sin(pose[2])
        v_n = cos * velocity[0] + sin * velocity[1]
        v_t = -sin * velocity[0] + cos * velocity[1]
        gap = self._slider.gap(pose, tip)
        if v_n <= 0.0 or gap > _CONTACT_GAP:
            return pose
        travel = math.hypot(v_n, v_t) * duration
        p_y = self._slider.contact_offset(pose, tip)
        x, y, theta = table.rate(p_y, math.atan2(v_n, v_t))
        # the heading of the middle of the step makes a circle of an even push
        cos, sin = (
            math.cos(pose[2] + 0.5 * theta * travel),
            math.sin(pose[2] + 0.5 * theta * travel),
        )
        step = np.array([cos * x - sin * y, sin * x + cos * y, theta])
        return np.asarray(pose + travel * step)
