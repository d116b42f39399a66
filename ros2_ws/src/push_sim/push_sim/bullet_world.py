"""The world in PyBullet: how it is reset, stepped and looked at.

The axes of the physics follow the slider's heading. Bullet keeps friction parallel to the slip
only along axes in which a foot is equally heavy, which here are those of the slider; with fixed
axes the same push would turn the slider by a few per cent more or less with its heading.
"""

import math
from collections.abc import Sequence

import numpy as np
from push_core.actuator import Pair
from push_core.errors import InputError
from push_core.frames import Array, wrap_angle
from push_core.limit_surface import GRAVITY
from push_core.quaternion import quaternion_to_yaw, yaw_to_quaternion
from push_core.slider import Slider

from push_sim.axes import Axes
from push_sim.bullet import pybullet
from push_sim.bullet_bodies import HALF_HEIGHT, make_object, make_tip, resting_height
from push_sim.bullet_snapshot import BulletSnapshot, put_server_state, server_state
from push_sim.bullet_table import UnevenTable, make_table
from push_sim.impact import DEEPEST, part_until_touch
from push_sim.outline import Outline
from push_sim.settings import WorldSettings
from push_sim.support import feet
from push_sim.symmetry import PLAIN, Symmetry, symmetry
from push_sim.table_friction import TableFriction

_CONTACT_RANGE = 1e-3
_FOLLOW_TIME = 0.01
_USUAL_STEP = 1e-3
_ASIDE = (0.0, 0.0, 10.0)
_REST = (0.0, 0.0, 0.0)
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


class BulletWorld:
    """A `World` of PyBullet, in a physics server of its own."""

    def __init__(self, settings: WorldSettings, slider: Slider) -> None:
        self._settings, self._slider = settings, slider
        self._outline = Outline(slider.side, slider.tip_radius)
        self._resting_height = resting_height(settings, slider)
        self._follow_steps = max(1, round(_FOLLOW_TIME / settings.substep))
        # slower than this, the tip cannot get deep in a time step
        self._fast = (1.0 + 1e-6) * DEEPEST / settings.substep
        self._table: UnevenTable | None = None
        self._seed = 0
        self._client = pybullet.connect(pybullet.DIRECT)
        self._make(seed=0)
        self.reset(np.zeros(3), np.array([-2.0 * slider.side, 0.0]))

    def close(self) -> None:
        """See `World.close`."""
        pybullet.disconnect(self._client)

    def reset(self, object_pose: Array, tip_position: Array, seed: int = 0) -> None:
        """See `World.reset`."""
        self._draw(seed)
        x, y, theta = map(float, object_pose)
        tip = (float(tip_position[0]), float(tip_position[1]))
        if self._settings.size_error:
            x, y, theta = self._outline.made_room((x, y, theta), tip)
        self._impulse: Pair | None = None
        self._knocked_steps = 0
        self._forget_contacts()
        self._put_down((x, y, theta), tip, PLAIN)
        self._aligned = self._settings.uneven or self._settings.pressure == 'random'

    def advance(self, tip_velocity: Pair, substeps: int) -> None:
        """See `World.advance`."""
        self.follow([(float(tip_velocity[0]), float(tip_velocity[1]))] * substeps)

    def follow(self, tip_velocities: Sequence[Pair]) -> None:
        """See `World.follow`."""
        if tip_velocities and not self._aligned:
            self._align(tip_velocities[0])
        if self._impulse is not None:
            self._apply_impulse(self._impulse)
        for velocity in tip_velocities:
            if self._steps_left == 0:
                self._follow_heading()
            self._steps_left -= 1
            if self._table is not None:
                self._update_friction(self._table)
            inside = self._axes.vector_inside(velocity)
            if self._may_hit(velocity):
                self._step_to_touch(inside)
            else:
                self._step(inside)

    def place_object(self, object_pose: Array) -> None:
        """See `World.place_object`."""
        x, y, theta = map(float, object_pose)
        x, y = self._axes.point_inside((x, y))
        turn = self._axes.heading_inside(theta + self._symmetry.turn)
        self._place(self._object, (x, y, self._resting_height), turn)
        if self._table is not None:
            self._steps_left = 0

    def place_tip(self, position: Array) -> None:
        """See `World.place_tip`."""
        x, y = self._axes.point_inside((float(position[0]), float(position[1])))
        self._place(self._tip, (x, y, HALF_HEIGHT), 0.0)

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
            server_state(self._client),
            self._seed,
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
        self._draw(snapshot.seed)
        put_server_state(self._client, snapshot.server)
        self._axes, self._symmetry = Axes(*snapshot.axes), snapshot.symmetry
        self._aligned = snapshot.aligned
        self._steps_left, self._knocked_steps = snapshot.steps_left, snapshot.knocked_steps
        self._impulse = snapshot.impulse

    @property
    def object_pose(self) -> Array:
        """See `World.object_pose`."""
        slider = self._slider_inside()
        x, y = self._axes.point_outside((slider.x, slider.y))
        theta = self._axes.heading_outside(slider.theta) - self._symmetry.turn
        return np.array([x, y, wrap_angle(theta)])

    @property
    def tip_position(self) -> Array:
        """See `World.tip_position`."""
        return np.array(self._axes.point_outside(self._tip_inside()))

    @property
    def contact(self) -> bool:
        """See `World.contact`."""
        points = pybullet.getContactPoints(self._tip, self._object, physicsClientId=self._client)
        normal_force = 9
        return any(point[normal_force] > 0.0 for point in points)

    @property
    def penetration(self) -> float:
        """Deepest overlap [m] of any two bodies in the last time step."""
        distance = 8
        points = pybullet.getContactPoints(physicsClientId=self._client)
        return max((-float(point[distance]) for point in points), default=0.0)

    def _draw(self, seed: int) -> None:
        """Makes what depends on the seed anew, if it is another one than before."""
        if seed == self._seed:
            return
        if self._settings.pressure == 'random':
            pybullet.resetSimulation(physicsClientId=self._client)
            self._make(seed)
        elif self._settings.uneven:
            self._table = self._uneven_table(seed)
        self._seed = seed

    def _make(self, seed: int) -> None:
        """Makes all bodies in an empty physics server."""
        client, settings, slider = self._client, self._settings, self._slider
        self._set_up_solver(settings.substep)
        self._tables = make_table(client, settings)
        self._feet = feet(settings, slider.side, seed)
        self._object = make_object(client, slider, self._feet)
        self._tip = make_tip(client, settings, slider)
        for table in self._tables:
            pybullet.setCollisionFilterPair(self._tip, table, -1, -1, 0, physicsClientId=client)
        self._table = self._uneven_table(seed) if settings.uneven else None

    def _uneven_table(self, seed: int) -> UnevenTable:
        friction = TableFriction(self._settings, seed)
        return UnevenTable(self._client, self._tables, self._feet, friction)

    def _set_up_solver(self, substep: float) -> None:
        settings, client = self._settings, self._client
        pybullet.setGravity(0.0, 0.0, -GRAVITY, physicsClientId=client)
        pybullet.setPhysicsEngineParameter(
            numSolverIterations=settings.solver_iterations,
            # impulses grow with the step: the same error of the forces in any step
            solverResidualThreshold=settings.solver_residual * (substep / _USUAL_STEP) ** 2,
            contactBreakingThreshold=_CONTACT_RANGE,
            enableConeFriction=1,
            deterministicOverlappingPairs=1,
            physicsClientId=client,
        )
        self._set_substep(substep)

    def _set_substep(self, substep: float) -> None:
        pybullet.setPhysicsEngineParameter(fixedTimeStep=substep, physicsClientId=self._client)
        # gravity takes this vertical speed from the tip in each step, so that it stays level
        self._lift = GRAVITY * substep

    def _step(self, velocity: Pair) -> None:
        """One time step of the physics with the tip at a velocity in its axes."""
        linear = (velocity[0], velocity[1], self._lift)
        pybullet.resetBaseVelocity(self._tip, linear, _REST, self._client)
        pybullet.stepSimulation(self._client)

    def _may_hit(self, velocity: Pair) -> bool:
        """Whether the tip could get deep into the slider within a time step."""
        if self._knocked_steps > 0:
            self._knocked_steps -= 1
            return True
        return math.hypot(*velocity) > self._fast

    def _step_to_touch(self, velocity: Pair) -> None:
        """A time step, cut in two where the tip meets the slider in it."""
        substep = self._settings.substep
        part = self._part_until_touch(velocity, substep)
        if part < 1.0:
            self._set_substep(part * substep)
            self._step(velocity)
            self._set_substep((1.0 - part) * substep)
        self._step(velocity)
        if part < 1.0:
            self._set_substep(substep)

    def _part_until_touch(self, velocity: Pair, substep: float) -> float:
        slider, (x, y) = self._slider_inside(), self._tip_inside()
        (u, v, _), (_, _, turning) = pybullet.getBaseVelocity(self._object, self._client)
        later = Axes(
            slider.x + u * substep, slider.y + v * substep, slider.theta + turning * substep
        )
        end = (x + velocity[0] * substep, y + velocity[1] * substep)
        return part_until_touch(
            self._outline, slider.point_inside((x, y)), later.point_inside(end)
        )

    def _update_friction(self, table: UnevenTable) -> None:
        linear, angular = pybullet.getBaseVelocity(self._object, self._client)
        table.update(self._axes, self._slider_inside(), linear[:2], angular[2])

    def _follow_heading(self) -> None:
        """Turns the axes of the physics along the slider and moves their origin under it."""
        client, slider = self._client, self._slider_inside()
        (_, _, height), (q_x, q_y, q_z, q_w) = self._where(self._object)
        linear, angular = pybullet.getBaseVelocity(self._object, client)
        x, y = slider.point_inside(self._tip_inside())
        _, _, back_z, back_w = yaw_to_quaternion(-slider.theta)
        level = (
            back_w * q_x - back_z * q_y,
            back_w * q_y + back_z * q_x,
            back_w * q_z + back_z * q_w,
            back_w * q_w - back_z * q_z,
        )
        pybullet.resetBasePositionAndOrientation(self._object, (0.0, 0.0, height), level, client)
        pybullet.resetBaseVelocity(
            self._object,
            (*slider.vector_inside(linear[:2]), linear[2]),
            (*slider.vector_inside(angular[:2]), angular[2]),
            client,
        )
        pybullet.resetBasePositionAndOrientation(self._tip, (x, y, HALF_HEIGHT), _UPRIGHT, client)
        x, y = self._axes.point_outside((slider.x, slider.y))
        theta = wrap_angle(self._axes.heading_outside(slider.theta))
        self._axes = Axes(x, y, theta, self._axes.side)
        self._steps_left = self._follow_steps

    def _align(self, velocity: Pair) -> None:
        """Sees the push that begins from its face and half."""
        x, y, theta = self.object_pose.tolist()
        tip = self._axes.point_outside(self._tip_inside())
        seen = symmetry((x, y, theta), tip, velocity)
        self._put_down(self._outline.touched((x, y, theta), tip), tip, seen)
        self._aligned = True

    def _put_down(self, pose: tuple[float, float, float], tip: Pair, seen: Symmetry) -> None:
        """Puts slider and tip down at rest, with the axes of the physics under the slider."""
        self._symmetry = seen
        self._axes = Axes(pose[0], pose[1], pose[2] + seen.turn, seen.side)
        self._steps_left = self._follow_steps
        self.place_object(np.array(pose))
        self.place_tip(np.array(tip))

    def _forget_contacts(self) -> None:
        """Lifts the slider off everything for a step, so that no cached contact is left."""
        pybullet.resetBasePositionAndOrientation(self._object, _ASIDE, _UPRIGHT, self._client)
        pybullet.resetBaseVelocity(self._object, _REST, _REST, self._client)
        pybullet.stepSimulation(self._client)

    def _where(self, body: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Position [m] and quaternion of a body in the axes of the physics."""
        position, orientation = pybullet.getBasePositionAndOrientation(body, self._client)
        return position, orientation

    def _slider_inside(self) -> Axes:
        """The slider in the axes of the physics."""
        (x, y, _), (_, _, q_z, q_w) = self._where(self._object)
        return Axes(x, y, quaternion_to_yaw(q_z, q_w))

    def _tip_inside(self) -> Pair:
        (x, y, _), _ = self._where(self._tip)
        return x, y

    def _place(self, body: int, position: tuple[float, float, float], theta: float) -> None:
        """Puts a body down at rest."""
        turn = yaw_to_quaternion(theta)
        pybullet.resetBasePositionAndOrientation(body, position, turn, self._client)
        pybullet.resetBaseVelocity(body, _REST, _REST, self._client)

    def _apply_impulse(self, impulse: Pair) -> None:
        substep = self._settings.substep
        x, y = self._axes.vector_inside(impulse)
        position, _ = self._where(self._object)
        pybullet.applyExternalForce(
            self._object,
            -1,
            (x / substep, y / substep, 0.0),
            position,
            pybullet.WORLD_FRAME,
            physicsClientId=self._client,
        )
        self._impulse = None
