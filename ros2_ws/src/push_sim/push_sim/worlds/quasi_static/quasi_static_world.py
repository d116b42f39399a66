"""The quasi-static engine: a square with an ellipsoidal limit surface and without inertia.

A pushed square moves by the integrated motion cone. After an impulse it slides in a straight line
with the deceleration of Coulomb friction, and stops if it meets the tip. Bodies overlap by less
than a picometre; a square that is placed on the tip is moved to contact.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array, wrap_angle
from push_core.physics import GRAVITY, Pair, Slider

from push_sim.settings import WorldSettings
from push_sim.worlds.common import Axes, Outline, feet, friction_moment_radius
from push_sim.worlds.quasi_static.rolling_contact import RollingContact, Touch

_OVERLAP = 1e-12
_SMALLEST_TRAVEL = 0.25e-3
_BISECTIONS = 40


@dataclass(frozen=True)
class QuasiStaticSnapshot:
    """The complete state of a `QuasiStaticWorld`."""

    rolling: RollingContact
    pose: tuple[float, float, float]
    tip: Pair
    sliding: Pair
    touch: Touch | None
    pressing: bool


class QuasiStaticWorld:
    """A `World` with quasi-static mechanics."""

    def __init__(self, settings: WorldSettings, slider: Slider) -> None:
        self._substep = settings.substep
        self._settings = settings
        self._side = slider.side
        self._mass = slider.mass
        self._deceleration = settings.friction_ground * GRAVITY
        self._touch: Touch | None = None
        self._outline = Outline(slider.side, slider.tip_radius)
        self.reset(np.zeros(3), np.array([-2.0 * slider.side, 0.0]))

    def close(self) -> None:
        """Does nothing: there are no resources."""

    def reset(self, object_pose: Array, tip_position: Array, seed: int = 0) -> None:
        """See `World.reset`."""
        settings = self._settings
        c = friction_moment_radius(feet(settings, self._side, seed))
        self._rolling = RollingContact(self._outline, c, settings.friction_pusher)
        self.place_tip(tip_position)
        self.place_object(object_pose)
        if settings.size_error:
            self._remove_overlap()

    def place_object(self, object_pose: Array) -> None:
        """See `World.place_object`."""
        x, y, theta = np.asarray(object_pose, dtype=float).tolist()
        self._pose = (x, y, theta)
        self._sliding: Pair = (0.0, 0.0)
        self._touch = None
        self._pressing = False

    def place_tip(self, position: Array) -> None:
        """See `World.place_tip`."""
        x, y = np.asarray(position, dtype=float).tolist()
        self._tip: Pair = (x, y)
        self._touch = None

    def push_object(self, impulse: Array) -> None:
        """See `World.push_object`."""
        x, y = np.asarray(impulse, dtype=float).tolist()
        self._sliding = (self._sliding[0] + x / self._mass, self._sliding[1] + y / self._mass)
        self._touch = None

    def advance(self, tip_velocity: Pair, substeps: int) -> None:
        """See `World.advance`."""
        velocity = (float(tip_velocity[0]), float(tip_velocity[1]))
        left = substeps * self._substep
        if self._touch is None:
            self._remove_overlap()
        while left > 0.0:
            left = self._push(velocity, left) if self._touch else self._approach(velocity, left)
        self._pressing = self._touch is not None

    def follow(self, tip_velocities: Sequence[Pair]) -> None:
        """See `World.follow`."""
        for velocity in tip_velocities:
            self.advance(velocity, 1)

    def set_friction(self, friction_ground: float, friction_pusher: float) -> None:
        """See `World.set_friction`."""
        self._settings = replace(
            self._settings, friction_ground=friction_ground, friction_pusher=friction_pusher
        )
        self._deceleration = friction_ground * GRAVITY
        self._rolling = replace(self._rolling, friction=friction_pusher)

    def snapshot(self) -> QuasiStaticSnapshot:
        """See `World.snapshot`."""
        return QuasiStaticSnapshot(
            self._rolling, self._pose, self._tip, self._sliding, self._touch, self._pressing
        )

    def restore(self, snapshot: object) -> None:
        """See `World.restore`."""
        if not isinstance(snapshot, QuasiStaticSnapshot):
            raise InputError('the snapshot is of another engine, not of quasi_static')
        self._rolling = snapshot.rolling
        self._pose, self._tip = snapshot.pose, snapshot.tip
        self._sliding, self._touch = snapshot.sliding, snapshot.touch
        self._pressing = snapshot.pressing

    @property
    def object_pose(self) -> Array:
        """See `World.object_pose`."""
        x, y, theta = self._pose
        return np.array([x, y, wrap_angle(theta)])

    @property
    def tip_position(self) -> Array:
        """See `World.tip_position`."""
        return np.array(self._tip)

    @property
    def contact(self) -> bool:
        """See `World.contact`."""
        return self._pressing

    @property
    def penetration(self) -> float:
        """See `World.penetration`."""
        return max(0.0, -self._gap())

    def _push(self, velocity: Pair, duration: float) -> float:
        """Pushes for a duration [s] or until the tip leaves; returns the remaining time [s]."""
        assert self._touch is not None
        touch, left = self._rolling.advance(self._touch, velocity, duration)
        self._move_tip(velocity, duration - left)
        self._pose = self._outline.pose_in_contact(*touch, self._tip)
        self._touch = touch if left == 0.0 else None
        return left

    def _approach(self, velocity: Pair, duration: float) -> float:
        """Moves both without contact until they touch; returns the remaining time [s]."""
        step = self._free_step(velocity, duration)
        before = self._tip, self._pose, self._sliding
        self._drift(velocity, step)
        if self._gap() >= -_OVERLAP:
            return duration - step
        low, high = 0.0, step
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            self._tip, self._pose, self._sliding = before
            self._drift(velocity, middle)
            low, high = (middle, high) if self._gap() >= 0.0 else (low, middle)
        self._sliding = (0.0, 0.0)
        self._begin_contact()
        return duration - high

    def _free_step(self, velocity: Pair, duration: float) -> float:
        """Duration [s] in which both approach by their gap at most, or by a short travel."""
        speed = math.hypot(*velocity) + math.hypot(*self._sliding)
        clear = max(self._gap(), _SMALLEST_TRAVEL)
        return min(duration, clear / speed) if speed > 0.0 else duration

    def _drift(self, velocity: Pair, duration: float) -> None:
        """Moves the tip, and the square if it slides."""
        self._move_tip(velocity, duration)
        speed = math.hypot(*self._sliding)
        if speed == 0.0:
            return
        slid = min(duration, speed / self._deceleration)
        lost = self._deceleration * slid / speed
        (x, y, theta), (u, v) = self._pose, self._sliding
        mean = slid * (1.0 - 0.5 * lost)
        self._pose = (x + mean * u, y + mean * v, theta)
        kept = 0.0 if slid < duration else 1.0 - lost
        self._sliding = (kept * u, kept * v)

    def _move_tip(self, velocity: Pair, duration: float) -> None:
        x, y = self._tip
        self._tip = (x + velocity[0] * duration, y + velocity[1] * duration)

    def _begin_contact(self) -> None:
        """Begins a contact at the point of the outline nearest to the tip."""
        touch = Touch(self._outline.nearest(*self._tip_in_body()), self._pose[2])
        self._touch, self._pose = touch, self._outline.pose_in_contact(*touch, self._tip)

    def _remove_overlap(self) -> None:
        """Moves the square to contact if it was placed on the tip."""
        self._pose = self._outline.without_overlap(self._pose, self._tip)

    def _gap(self) -> float:
        return self._outline.gap(*self._tip_in_body())

    def _tip_in_body(self) -> Pair:
        return Axes(*self._pose).point_from_world(self._tip)
