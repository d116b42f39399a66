"""The world in PyBullet: where the axes of its physics are, and what is seen through them.

The axes of the physics follow the slider's heading. Bullet keeps friction parallel to the slip
only along axes in which a foot is equally heavy, which here are those of the slider; with fixed
axes the same push would turn the slider by a few per cent more or less with its heading.
"""

import math
from collections.abc import Sequence

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
    """A `World` of PyBullet, in a physics server of its own."""

    def __init__(self, settings: WorldSettings, slider: Slider) -> None:
        self._settings, self._slider = settings, slider
        self._outline = Outline(slider.side, slider.tip_radius)
        self._scene = BulletScene(settings, slider, self._outline)
        self._follow_steps = max(1, round(_FOLLOW_TIME / settings.substep))
        # slower than this, the tip cannot get deep in a time step
        self._fast = (1.0 + 1e-6) * DEEPEST / settings.substep
        # a table and feet that are not alike on all sides look the same from no other side
        self._one_sided = settings.uneven or settings.pressure == 'random'
        self.reset(np.zeros(3), np.array([-2.0 * slider.side, 0.0]))

    def close(self) -> None:
        """See `World.close`."""
        self._scene.close()

    def reset(self, object_pose: Array, tip_position: Array, seed: int = 0) -> None:
        """See `World.reset`."""
        self._scene.draw(seed)
        x, y, theta = map(float, object_pose)
        tip = (float(tip_position[0]), float(tip_position[1]))
        if self._settings.size_error:
            x, y, theta = self._outline.without_overlap((x, y, theta), tip)
        self._impulse: Pair | None = None
        self._knocked_steps = 0
        self._scene.forget_contacts()
        self._put_down((x, y, theta), tip, IDENTITY)
        self._aligned = self._one_sided

    def advance(self, tip_velocity: Pair, substeps: int) -> None:
        """See `World.advance`."""
        self.follow([(float(tip_velocity[0]), float(tip_velocity[1]))] * substeps)

    def follow(self, tip_velocities: Sequence[Pair]) -> None:
        """See `World.follow`."""
        if tip_velocities and not self._aligned:
            self._align(tip_velocities[0])
        if self._impulse is not None:
            self._scene.knock(self._axes.vector_from_world(self._impulse))
            self._impulse = None
        for velocity in tip_velocities:
            if self._steps_left == 0:
                self._follow_heading()
            self._steps_left -= 1
            if self._settings.uneven:
                self._scene.rub(self._axes)
            inside = self._axes.vector_from_world(velocity)
            if self._may_hit(velocity):
                self._scene.step_cut_at_contact(inside)
            else:
                self._scene.step(inside)

    def place_object(self, object_pose: Array) -> None:
        """See `World.place_object`."""
        x, y, theta = map(float, object_pose)
        turn = self._axes.heading_from_world(theta + self._symmetry.turn)
        self._scene.put_slider(self._axes.point_from_world((x, y)), turn)
        if self._settings.uneven:
            self._steps_left = 0

    def place_tip(self, position: Array) -> None:
        """See `World.place_tip`."""
        x, y = map(float, position)
        self._scene.put_tip(self._axes.point_from_world((x, y)))

    def push_object(self, impulse: Array) -> None:
        """See `World.push_object`."""
        x, y = map(float, impulse)
        self._impulse = (x, y)
        stopping_time = math.hypot(x, y) / (self._slider.mass * self._settings.friction_ground)
        self._knocked_steps = math.ceil(2.0 * stopping_time / (GRAVITY * self._settings.substep))

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
            self._knocked_steps,
            self._impulse,
        )

    def restore(self, snapshot: object) -> None:
        """See `World.restore`."""
        if not isinstance(snapshot, BulletSnapshot):
            raise InputError('this snapshot is of another engine, not of bullet')
        self._scene.draw(snapshot.seed)
        self._scene.put_state(snapshot.server)
        self._axes, self._symmetry = Axes(*snapshot.axes), snapshot.symmetry
        self._aligned = snapshot.aligned
        self._steps_left, self._knocked_steps = snapshot.steps_left, snapshot.knocked_steps
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
        """Whether the tip could get deep into the slider within a time step."""
        if self._knocked_steps > 0:
            self._knocked_steps -= 1
            return True
        return math.hypot(*velocity) > self._fast

    def _follow_heading(self) -> None:
        """Turns the axes of the physics along the slider and moves their origin under it."""
        slider, axes = self._scene.move_axes_under_slider(), self._axes
        theta = wrap_angle(axes.heading_to_world(slider.theta))
        self._axes = Axes(*axes.point_to_world((slider.x, slider.y)), theta, axes.side)
        self._steps_left = self._follow_steps

    def _align(self, velocity: Pair) -> None:
        """Sees the push that begins from its face and half."""
        x, y, theta = self.object_pose.tolist()
        tip = self._axes.point_to_world(self._scene.tip)
        seen = Symmetry.of_push((x, y, theta), tip, velocity)
        self._put_down(self._outline.snapped_to_contact((x, y, theta), tip), tip, seen)
        self._aligned = True

    def _put_down(self, pose: Pose, tip: Pair, seen: Symmetry) -> None:
        """Puts slider and tip down at rest, with the axes of the physics under the slider."""
        self._symmetry = seen
        self._axes = Axes(pose[0], pose[1], pose[2] + seen.turn, seen.side)
        self._steps_left = self._follow_steps
        self.place_object(np.array(pose))
        self.place_tip(np.array(tip))
