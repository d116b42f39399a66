"""The PyBullet engine: maps the world to physics axes under the slider and back.

The physics axes follow the slider's heading. Bullet keeps friction parallel to the slip only if
the effective mass at a foot is the same along both axes, here those of the slider. With fixed axes
the rotation by the same push would depend on the heading by a few per cent.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array, wrap_angle
from push_core.physics import GRAVITY, Pair, Slider

from push_sim.settings import WorldSettings
from push_sim.worlds.bullet.impact import DEEPEST
from push_sim.worlds.bullet.scene import BulletScene
from push_sim.worlds.bullet.snapshot import BulletSnapshot
from push_sim.worlds.bullet.symmetry import IDENTITY, Symmetry
from push_sim.worlds.common import Axes, Outline, Pose

_FOLLOW_TIME = 0.01


class BulletWorld:
    """A `World` in its own PyBullet physics server."""

    def __init__(self, settings: WorldSettings, slider: Slider) -> None:
        self._settings, self._slider = settings, slider
        self._outline = Outline(slider.side, slider.tip_radius)
        self._scene = BulletScene(settings, slider, self._outline)
        self._follow_steps = max(1, round(_FOLLOW_TIME / settings.substep))
        # a slower tip cannot penetrate deeply in a time step
        self._fast = (1.0 + 1e-6) * DEEPEST / settings.substep
        # varying friction or random feet have no symmetry
        self._asymmetric = settings.uneven or settings.pressure == 'random'
        self.reset(np.zeros(3), np.array([-2.0 * slider.side, 0.0]))

    def close(self) -> None:
        """See `World.close`."""
        self._scene.close()

    def reset(self, object_pose: Array, tip_position: Array, seed: int = 0) -> None:
        """See `World.reset`."""
        self._scene.set_seed(seed)
        x, y, theta = map(float, object_pose)
        tip = (float(tip_position[0]), float(tip_position[1]))
        if self._settings.size_error:
            x, y, theta = self._outline.without_overlap((x, y, theta), tip)
        self._impulse: Pair | None = None
        self._sliding_steps = 0
        self._scene.clear_contacts()
        self._place((x, y, theta), tip, IDENTITY)
        self._aligned = self._asymmetric

    def advance(self, tip_velocity: Pair, substeps: int) -> None:
        """See `World.advance`."""
        self.follow([(float(tip_velocity[0]), float(tip_velocity[1]))] * substeps)

    def follow(self, tip_velocities: Sequence[Pair]) -> None:
        """See `World.follow`."""
        if tip_velocities and not self._aligned:
            self._align(tip_velocities[0])
        if self._impulse is not None:
            self._scene.apply_impulse(self._axes.vector_from_world(self._impulse))
            self._impulse = None
        for velocity in tip_velocities:
            if self._steps_left == 0:
                self._follow_heading()
            self._steps_left -= 1
            if self._settings.uneven:
                self._scene.update_friction(self._axes)
            inside = self._axes.vector_from_world(velocity)
            if self._may_hit(velocity):
                self._scene.step_cut_at_contact(inside)
            else:
                self._scene.step(inside)

    def place_object(self, object_pose: Array) -> None:
        """See `World.place_object`."""
        x, y, theta = map(float, object_pose)
        turn = self._axes.heading_from_world(theta + self._symmetry.turn)
        self._scene.place_slider(self._axes.point_from_world((x, y)), turn)
        if self._settings.uneven:
            self._steps_left = 0

    def place_tip(self, position: Array) -> None:
        """See `World.place_tip`."""
        x, y = map(float, position)
        self._scene.place_tip(self._axes.point_from_world((x, y)))

    def push_object(self, impulse: Array) -> None:
        """See `World.push_object`."""
        x, y = map(float, impulse)
        self._impulse = (x, y)
        stopping_time = math.hypot(x, y) / (self._slider.mass * self._settings.friction_ground)
        self._sliding_steps = math.ceil(2.0 * stopping_time / (GRAVITY * self._settings.substep))

    def set_friction(self, friction_ground: float, friction_pusher: float) -> None:
        """See `World.set_friction`."""
        self._settings = replace(
            self._settings, friction_ground=friction_ground, friction_pusher=friction_pusher
        )
        self._scene.set_friction(self._settings)

    def snapshot(self) -> BulletSnapshot:
        """See `World.snapshot`."""
        axes = self._axes
        return BulletSnapshot(
            self._scene.state(),
            self._scene.seed,
            (axes.x, axes.y, axes.theta, axes.side),
            self._symmetry,
            self._aligned,
            self._steps_left,
            self._sliding_steps,
            self._impulse,
        )

    def restore(self, snapshot: object) -> None:
        """See `World.restore`."""
        if not isinstance(snapshot, BulletSnapshot):
            raise InputError('the snapshot is of another engine, not of bullet')
        self._scene.set_seed(snapshot.seed)
        self._scene.restore_state(snapshot.server)
        self._axes, self._symmetry = Axes(*snapshot.axes), snapshot.symmetry
        self._aligned = snapshot.aligned
        self._steps_left, self._sliding_steps = snapshot.steps_left, snapshot.sliding_steps
        self._impulse = snapshot.impulse

    @property
    def object_pose(self) -> Array:
        """See `World.object_pose`."""
        slider = self._scene.slider
        x, y = self._axes.point_to_world((slider.x, slider.y))
        theta = self._axes.heading_to_world(slider.theta) - self._symmetry.turn
        return np.array([x, y, wrap_angle(theta)])

    @property
    def tip_position(self) -> Array:
        """See `World.tip_position`."""
        return np.array(self._axes.point_to_world(self._scene.tip))

    @property
    def contact(self) -> bool:
        """See `World.contact`."""
        return self._scene.contact

    @property
    def penetration(self) -> float:
        """See `World.penetration`."""
        return self._scene.penetration

    def _may_hit(self, velocity: Pair) -> bool:
        """Whether the tip could penetrate deeply within a time step."""
        if self._sliding_steps > 0:
            self._sliding_steps -= 1
            return True
        return math.hypot(*velocity) > self._fast

    def _follow_heading(self) -> None:
        """Moves the physics axes to the pose of the slider."""
        slider, axes = self._scene.move_axes_under_slider(), self._axes
        theta = wrap_angle(axes.heading_to_world(slider.theta))
        self._axes = Axes(*axes.point_to_world((slider.x, slider.y)), theta, axes.side)
        self._steps_left = self._follow_steps

    def _align(self, velocity: Pair) -> None:
        """Chooses the symmetry for the push that begins with a tip velocity [m/s]."""
        x, y, theta = self.object_pose.tolist()
        tip = self._axes.point_to_world(self._scene.tip)
        found = Symmetry.of_push((x, y, theta), tip, velocity)
        self._place(self._outline.snapped_to_contact((x, y, theta), tip), tip, found)
        self._aligned = True

    def _place(self, pose: Pose, tip: Pair, symmetry: Symmetry) -> None:
        """Places slider and tip at rest, with the physics axes under the slider."""
        self._symmetry = symmetry
        self._axes = Axes(pose[0], pose[1], pose[2] + symmetry.turn, symmetry.side)
        self._steps_left = self._follow_steps
        self.place_object(np.array(pose))
        self.place_tip(np.array(tip))
