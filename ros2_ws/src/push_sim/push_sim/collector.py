"""Short straight pushes in the simulator, made as the measured ones were.

The tip pushes at 20 mm/s; once the contact has settled, the motion of the object over the next
0.2 s is one row. Source: Bauza, Hogan and Rodriguez 2018, section 4.
"""

import math
from dataclasses import dataclass, replace

import numpy as np
from push_core.errors import InputError
from push_core.frames import Array, to_body, wrap_angle
from push_core.settings import setting, validate
from push_core.slider import Slider

from push_sim.sensor import Observation, Sensor
from push_sim.settings import SimSettings
from push_sim.worlds import make_world

_SUBSTEP = 0.005
_AT_ORIGIN = np.zeros(3)


@dataclass(frozen=True)
class PushDesign:
    """Which pushes are made."""

    speed: float = setting(0.02, 'speed of the tip', unit='m/s', low=1e-3, high=0.5)
    duration: float = setting(0.2, 'time of a push', unit='s', low=0.01, high=10.0)
    settling: float = setting(0.04, 'time of pushing before it', unit='s', low=0.0, high=10.0)
    face_part: float = setting(0.95, 'part of the face that is pushed on', low=0.01, high=1.0)
    steepest: float = setting(
        math.radians(84.0), 'largest angle to the normal', unit='rad', low=0.0, high=1.55
    )

    def __post_init__(self) -> None:
        validate(self)
        for name in ('duration', 'settling'):
            time = getattr(self, name)
            if not math.isclose(time, _steps(time) * _SUBSTEP, abs_tol=1e-9):
                raise InputError(f'parameter {name} is {time:g}, must be a multiple of 0.005 s')

    @property
    def distance(self) -> float:
        """Travel of the tip in a push [m]."""
        return self.speed * self.duration

    def draw(self, random: np.random.Generator, side: float) -> tuple[float, float]:
        """A contact offset p_y [m] and a direction beta [rad], uniform over both ranges."""
        p_y = random.uniform(-1.0, 1.0) * self.face_part * side / 2.0
        return p_y, math.pi / 2.0 + random.uniform(-1.0, 1.0) * self.steepest


def _steps(time: float) -> int:
    return round(time / _SUBSTEP)


class Collector:
    """Makes pushes one by one; each depends on seed and number alone."""

    def __init__(self, settings: SimSettings, slider: Slider, design: PushDesign) -> None:
        # a quasi-static push comes out the same with longer steps (2 um rms), five times faster
        self._world = make_world(replace(settings.world, substep=_SUBSTEP), slider)
        self._sensor = Sensor(settings.sensor)
        self._slider = slider
        self._design = design

    def push(self, seed: int, number: int) -> Array:
        """One row (5,): p_y [m], beta [rad], dx_b [m], dy_b [m], dtheta [rad].

        Draws until the tip stays on the face.
        """
        random = np.random.default_rng([seed, number])
        self._sensor.reset(random)
        while True:
            p_y, beta = self._design.draw(random, self._slider.side)
            before, after = self.seen(p_y, beta)
            if abs(self._offset(after)) <= self._slider.side / 2.0:
                return self._row(before, after)

    def seen(self, p_y: float, beta: float) -> tuple[Observation, Observation]:
        """Pushes from contact offset p_y [m] in direction beta [rad]; returns start and end."""
        speed = self._design.speed
        velocity = speed * math.sin(beta), speed * math.cos(beta)
        self._world.reset(_AT_ORIGIN, self._slider.tip_position(_AT_ORIGIN, p_y))
        self._world.advance(velocity, _steps(self._design.settling))
        before = self._look()
        self._world.advance(velocity, _steps(self._design.duration))
        return before, self._look()

    def _look(self) -> Observation:
        seen = self._sensor.seen(self._world.object_pose)
        return Observation(0.0, seen, self._world.tip_position)

    def _row(self, before: Observation, after: Observation) -> Array:
        travel = after.tip_position - before.tip_position
        theta = before.object_pose[2]
        beta = math.pi / 2.0 - wrap_angle(math.atan2(travel[1], travel[0]) - theta)
        moved = to_body(before.object_pose, after.object_pose[:2])
        turned = wrap_angle(after.object_pose[2] - theta)
        return np.array([self._offset(before), beta, *moved, turned])

    def _offset(self, seen: Observation) -> float:
        return self._slider.contact_offset(seen.object_pose, seen.tip_position)
