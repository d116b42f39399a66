"""The world in PyBullet: how it is reset, stepped and looked at.

The axes of the physics follow the slider's heading. Bullet keeps friction parallel to the slip
only along axes in which a foot is equally heavy, which here are those of the slider; with fixed
axes the same push would turn the slider by a few per cent more or less with its heading.
"""

import math
from dataclasses import dataclass

import numpy as np
from push_core.actuator import Pair
from push_core.errors import InputError
from push_core.frames import Array, rotation, to_body, to_world, wrap_angle
from push_core.limit_surface import GRAVITY
from push_core.quaternion import quaternion_to_yaw, yaw_to_quaternion
from push_core.slider import Slider

from push_sim.bullet import pybullet
from push_sim.bullet_bodies import (
    HALF_HEIGHT,
    make_object,
    make_table,
    make_tip,
    resting_height,
)
from push_sim.bullet_snapshot import put_server_state, server_state
from push_sim.settings import WorldSettings

_CONTACT_RANGE = 1e-3
_FOLLOW_TIME = 0.01
_ASIDE = (0.0, 0.0, 10.0)
_REST = (0.0, 0.0, 0.0)
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class BulletSnapshot:
    """The whole state of a `BulletWorld`.

    Attributes:
        server: that of the physics server.
        axes: pose (3,) of the axes of the physics.
        steps_left: until the axes follow the slider again.
        impulse: (2,) that the next time step gives, if any [N s].
    """

    server: bytes
    axes: tuple[float, ...]
    steps_left: int
    impulse: tuple[float, ...] | None


class BulletWorld:
    """A `World` of PyBullet, in a physics server of its own."""

    def __init__(self, settings: WorldSettings, slider: Slider) -> None:
        self._substep = settings.substep
        self._client = pybullet.connect(pybullet.DIRECT)
        self._set_up_solver(settings)
        table = make_table(self._client, settings)
        self._object = make_object(self._client, settings, slider)
        self._tip = make_tip(self._client, settings, slider)
        pybullet.setCollisionFilterPair(self._tip, table, -1, -1, 0, physicsClientId=self._client)
        self._resting_height = resting_height(settings, slider)
        # gravity takes this vertical speed from the tip in each step, so that it stays level
        self._lift = GRAVITY * settings.substep
        self._impulse: Array | None = None
        self._set_axes(np.zeros(3))
        self._follow_steps = max(1, round(_FOLLOW_TIME / settings.substep))
        self._steps_left = self._follow_steps

    def close(self) -> None:
        """Ends the physics server."""
        pybullet.disconnect(self._client)

    def reset(self, object_pose: Array, tip_position: Array) -> None:
        """See `World.reset`."""
        self._impulse = None
        self._forget_contacts()
        self._set_axes(np.array(object_pose, dtype=float))
        self._steps_left = self._follow_steps
        self.place_object(object_pose)
        self.place_tip(tip_position)

    def advance(self, tip_velocity: Pair, substeps: int) -> None:
        """See `World.advance`."""
        if self._impulse is not None:
            self._apply_impulse(self._impulse)
        while substeps > 0:
            if self._steps_left == 0:
                self._follow_heading()
            count = min(substeps, self._steps_left)
            self._run(tip_velocity, count)
            substeps -= count
            self._steps_left -= count

    def place_object(self, object_pose: Array) -> None:
        """See `World.place_object`."""
        x, y = to_body(self._axes, object_pose[:2]).tolist()
        turn = yaw_to_quaternion(float(object_pose[2] - self._axes[2]))
        self._place(self._object, (x, y, self._resting_height), turn)

    def place_tip(self, position: Array) -> None:
        """See `World.place_tip`."""
        x, y = to_body(self._axes, position).tolist()
        self._place(self._tip, (x, y, HALF_HEIGHT), _UPRIGHT)

    def push_object(self, impulse: Array) -> None:
        """See `World.push_object`."""
        self._impulse = np.array(impulse, dtype=float)

    def snapshot(self) -> BulletSnapshot:
        """See `World.snapshot`."""
        impulse = None if self._impulse is None else tuple(self._impulse.tolist())
        axes = tuple(self._axes.tolist())
        return BulletSnapshot(server_state(self._client), axes, self._steps_left, impulse)

    def restore(self, snapshot: object) -> None:
        """See `World.restore`."""
        if not isinstance(snapshot, BulletSnapshot):
            raise InputError('this snapshot is of another engine, not of bullet')
        put_server_state(self._client, snapshot.server)
        self._set_axes(np.array(snapshot.axes))
        self._steps_left = snapshot.steps_left
        self._impulse = None if snapshot.impulse is None else np.array(snapshot.impulse)

    @property
    def object_pose(self) -> Array:
        """See `World.object_pose`."""
        (x, y, _), (_, _, q_z, q_w) = self._where(self._object)
        theta = wrap_angle(self._axes[2] + quaternion_to_yaw(q_z, q_w))
        return np.array([*to_world(self._axes, np.array([x, y])), theta])

    @property
    def tip_position(self) -> Array:
        """See `World.tip_position`."""
        (x, y, _), _ = self._where(self._tip)
        return to_world(self._axes, np.array([x, y]))

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

    def _set_up_solver(self, settings: WorldSettings) -> None:
        pybullet.setGravity(0.0, 0.0, -GRAVITY, physicsClientId=self._client)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=settings.substep,
            numSolverIterations=settings.solver_iterations,
            solverResidualThreshold=settings.solver_residual,
            contactBreakingThreshold=_CONTACT_RANGE,
            enableConeFriction=1,
            deterministicOverlappingPairs=1,
            physicsClientId=self._client,
        )

    def _run(self, velocity: Pair, substeps: int) -> None:
        linear = (*_turned(velocity, *self._heading), self._lift)
        client, tip = self._client, self._tip
        for _ in range(substeps):
            pybullet.resetBaseVelocity(tip, linear, _REST, physicsClientId=client)
            pybullet.stepSimulation(client)

    def _set_axes(self, axes: Array) -> None:
        self._axes = axes
        self._heading = math.cos(axes[2]), math.sin(axes[2])

    def _follow_heading(self) -> None:
        """Turns the axes of the physics along the slider and moves their origin under it."""
        client = self._client
        (x, y, height), orientation = self._where(self._object)
        linear, angular = pybullet.getBaseVelocity(self._object, client)
        (tip_x, tip_y, _), _ = self._where(self._tip)
        yaw = quaternion_to_yaw(*orientation[2:])
        heading = math.cos(yaw), math.sin(yaw)
        back = yaw_to_quaternion(-yaw)
        _, level = pybullet.multiplyTransforms(_REST, back, _REST, orientation)
        tip = _turned((tip_x - x, tip_y - y), *heading)

        self._place(self._object, (0.0, 0.0, height), level)
        pybullet.resetBaseVelocity(
            self._object,
            (*_turned(linear[:2], *heading), linear[2]),
            (*_turned(angular[:2], *heading), angular[2]),
            physicsClientId=client,
        )
        self._place(self._tip, (*tip, HALF_HEIGHT), _UPRIGHT)
        origin = to_world(self._axes, np.array([x, y]))
        self._set_axes(np.array([*origin, wrap_angle(self._axes[2] + yaw)]))
        self._steps_left = self._follow_steps

    def _forget_contacts(self) -> None:
        """Lifts the slider off everything for a step, so that no cached contact is left."""
        self._place(self._object, _ASIDE, _UPRIGHT)
        pybullet.stepSimulation(self._client)

    def _where(self, body: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Position [m] and quaternion of a body in the axes of the physics."""
        position, orientation = pybullet.getBasePositionAndOrientation(body, self._client)
        return position, orientation

    def _place(
        self, body: int, position: tuple[float, ...], orientation: tuple[float, ...]
    ) -> None:
        pybullet.resetBasePositionAndOrientation(
            body, position, orientation, physicsClientId=self._client
        )
        pybullet.resetBaseVelocity(body, _REST, _REST, physicsClientId=self._client)

    def _apply_impulse(self, impulse: Array) -> None:
        force = rotation(self._axes[2]).T @ impulse / self._substep
        position, _ = self._where(self._object)
        pybullet.applyExternalForce(
            self._object,
            -1,
            (*force.tolist(), 0.0),
            position,
            pybullet.WORLD_FRAME,
            physicsClientId=self._client,
        )
        self._impulse = None


def _turned(vector: Pair, cos: float, sin: float) -> Pair:
    """A vector as seen from axes that are turned by the angle of this cosine and sine."""
    return cos * vector[0] + sin * vector[1], cos * vector[1] - sin * vector[0]
