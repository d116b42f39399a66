"""Delay predictor: the state at the time at which the next command takes effect.

The measured state is rolled forward through the commands already sent, with the model of the
object and the model of the robot's lag (a Smith predictor for a nonlinear plant).
"""

import math
from typing import TypeAlias

import numpy as np
from push_core.geometry import Array
from push_core.physics import Actuator, ActuatorSettings, Pair, Slider

from push_mpc.table import Table

Pose: TypeAlias = tuple[float, float, float]
_STEP = 0.01
_TIME_TOLERANCE = 1e-6
_CONTACT_GAP = 5e-4
_BRAKED = 0.015  # [s] of braking after which the object hardly moves on


class Predictor:
    """Integrates a copy of the actuator and the motion model over the commands under way."""

    def __init__(
        self, settings: ActuatorSettings, slider: Slider, command_timeout: float = math.inf
    ) -> None:
        """Starts at rest.

        Args:
            settings: of the robot.
            slider: geometry of slider and tip.
            command_timeout: time [s] without a command after which the robot's driver brakes.
        """
        self._slider = slider
        self._timeout = command_timeout
        self._now = Actuator(settings)
        self._ahead = Actuator(settings)
        self._time = self._last_sent = -math.inf
        self._horizon = settings.dead_time + settings.lag

    @property
    def horizon(self) -> float:
        """Time [s] from a command to its effect: dead time plus lag."""
        return self._horizon

    def reset(self) -> None:
        """Clears the command history; the robot is at rest."""
        self._now.reset()
        self._time = self._last_sent = -math.inf

    def has_braked(self, time: float) -> bool:
        """Whether the robot's driver has braked at a time [s] for want of commands."""
        return -math.inf < self._last_sent < time - self._timeout - _BRAKED

    def sent(self, velocity: Array, time: float) -> None:
        """Records a command (2,) [m/s] sent at a time [s]."""
        if -math.inf < self._last_sent < time - self._timeout:
            # the driver brakes until the command arrives
            self._follow(time)
        self._now.command(velocity, time)
        self._last_sent = time

    def predict(
        self,
        table: Table,
        disturbance: Array,
        object_pose: Array,
        tip: Array,
        exposure: float,
        until: float,
    ) -> tuple[Array, Array]:
        """Predicts object pose (3,) and tip position (2,).

        Args:
            table: model of the object.
            disturbance: estimated model error per metre of travel (3,) [1, 1, rad/m].
            object_pose: measured pose (3,) at the exposure.
            tip: measured tip position (2,) at the exposure.
            exposure: time of the measurement [s]; never decreases.
            until: time of the prediction [s].
        """
        self._follow(exposure)
        self._ahead.copy_state(self._now)
        pose, place = tuple(object_pose.tolist()), tuple(tip.tolist())
        error = tuple(disturbance.tolist())
        time = exposure
        while until - time > _TIME_TOLERANCE:
            duration = min(_STEP, until - time)
            velocity = self._ahead.advance(time, duration)
            pose = self._pushed(table, error, pose, place, velocity, duration)
            place = (place[0] + velocity[0] * duration, place[1] + velocity[1] * duration)
            time += duration
        return np.array(pose), np.array(place)

    def _follow(self, exposure: float) -> None:
        """Advances the actuator copy to the exposure."""
        if self._time == -math.inf:
            self._time = exposure
        while exposure - self._time > _TIME_TOLERANCE:
            duration = min(_STEP, exposure - self._time)
            if self._time - self._last_sent > self._timeout:
                self._now.brake(duration)
            else:
                self._now.advance(self._time, duration)
            self._time += duration

    def _pushed(
        self,
        table: Table,
        error: tuple[float, float, float],
        pose: Pose,
        tip: Pair,
        velocity: Pair,
        duration: float,
    ) -> Pose:
        """The object's pose after one step of the tip; it rests without contact."""
        x, y, theta = pose
        cos, sin = math.cos(theta), math.sin(theta)
        v_n = cos * velocity[0] + sin * velocity[1]
        along = cos * (tip[0] - x) + sin * (tip[1] - y)
        if v_n <= 0.0 or along < self._slider.tip_x - _CONTACT_GAP:
            return pose
        v_t = cos * velocity[1] - sin * velocity[0]
        p_y = cos * (tip[1] - y) - sin * (tip[0] - x)
        travel = math.hypot(v_n, v_t) * duration
        rate = table.rate(p_y, math.atan2(v_n, v_t))
        dx, dy, turn = (known + more for known, more in zip(rate, error, strict=True))
        # midpoint heading: exact for a constant body twist on a circle
        middle = theta + 0.5 * turn * travel
        cos, sin = math.cos(middle), math.sin(middle)
        return (
            x + travel * (cos * dx - sin * dy),
            y + travel * (sin * dx + cos * dy),
            theta + travel * turn,
        )
