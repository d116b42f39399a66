"""The world in PyBullet.

- The slider is a box on feet that stand on a circle, not on its corners: that gives the friction
  moment of the measured limit surface.
- The feet are springs. Four rigid feet share the weight as the solver's order of rows pleases,
  and the slider turns to one side; springs share it as the load does.
- The feet stand on the diagonals, and the axes of the physics follow the slider's heading.
  Bullet's friction is parallel to the slip only where a foot is equally heavy along both axes;
  with fixed axes a push would turn the slider by up to 10 % more or less with its heading.
- The tip is a sphere, one contact point at half height, so heavy that the slider cannot slow it.
- PyBullet multiplies the friction coefficients of two bodies: the slider has 1, table and tip
  have theirs.
- Multibody coordinates with cone friction: maximal coordinates are faster, but hold the friction
  of a sticking contact to one direction.
"""

import math

import numpy as np
from push_core.actuator import Pair
from push_core.frames import Array, rotation, to_body, to_world, wrap_angle
from push_core.limit_surface import GRAVITY
from push_core.quaternion import quaternion_to_yaw, yaw_to_quaternion
from push_core.slider import Slider

from push_sim.bullet import pybullet
from push_sim.settings import WorldSettings

_HALF_HEIGHT = 0.0065
_FEET = 4
_FOOT_RADIUS = 0.001
_TIP_MASS = 1e6
_CONTACT_RANGE = 1e-3
_FOLLOW_TIME = 0.01
_ASIDE = (0.0, 0.0, 10.0)
_REST = (0.0, 0.0, 0.0)
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


class BulletWorld:
    """A `World` of PyBullet, in a physics server of its own."""

    def __init__(self, settings: WorldSettings, slider: Slider) -> None:
        self._settings = settings
        self._client = pybullet.connect(pybullet.DIRECT)
        self._set_up_solver()
        self._table = self._make_table()
        self._object = self._make_object(slider)
        self._tip = self._make_tip(slider.tip_radius)
        pybullet.setCollisionFilterPair(
            self._tip, self._table, -1, -1, 0, physicsClientId=self._client
        )
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
        self._place_tip(tip_position)

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

    def push_object(self, impulse: Array) -> None:
        """See `World.push_object`."""
        self._impulse = np.array(impulse, dtype=float)

    @property
    def object_pose(self) -> Array:
        """See `World.object_pose`."""
        (x, y, _), (_, _, q_z, q_w) = pybullet.getBasePositionAndOrientation(
            self._object, self._client
        )
        theta = wrap_angle(self._axes[2] + quaternion_to_yaw(q_z, q_w))
        return np.array([*to_world(self._axes, np.array([x, y])), theta])

    @property
    def tip_position(self) -> Array:
        """See `World.tip_position`."""
        position, _ = pybullet.getBasePositionAndOrientation(self._tip, self._client)
        return to_world(self._axes, np.array(position[:2]))

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

    @property
    def _resting_height(self) -> float:
        sinking = self._mass * GRAVITY / (_FEET * self._settings.stiffness)
        return _HALF_HEIGHT - sinking

    def _set_up_solver(self) -> None:
        pybullet.setGravity(0.0, 0.0, -GRAVITY, physicsClientId=self._client)
        pybullet.setPhysicsEngineParameter(
            fixedTimeStep=self._settings.substep,
            numSolverIterations=self._settings.solver_iterations,
            solverResidualThreshold=self._settings.solver_residual,
            contactBreakingThreshold=_CONTACT_RANGE,
            enableConeFriction=1,
            deterministicOverlappingPairs=1,
            physicsClientId=self._client,
        )

    def _make_table(self) -> int:
        plane = pybullet.createCollisionShape(pybullet.GEOM_PLANE, physicsClientId=self._client)
        table = self._make_body(0.0, plane, self._settings.friction_ground)
        pybullet.changeDynamics(
            table,
            -1,
            contactStiffness=self._settings.stiffness,
            contactDamping=self._settings.damping,
            physicsClientId=self._client,
        )
        return table

    def _make_object(self, slider: Slider) -> int:
        self._mass = slider.mass
        body = self._make_body(slider.mass, self._object_shape(slider.side), 1.0)
        yaw_inertia = slider.mass * slider.side**2 / 6.0
        pybullet.changeDynamics(
            body,
            -1,
            localInertiaDiagonal=(0.5 * yaw_inertia, 0.5 * yaw_inertia, yaw_inertia),
            physicsClientId=self._client,
        )
        return body

    def _object_shape(self, side: float) -> int:
        """A box, clear of the table, on spheres as feet."""
        half_box = (side / 2.0, side / 2.0, _HALF_HEIGHT - _FOOT_RADIUS)
        return int(
            pybullet.createCollisionShapeArray(
                shapeTypes=[pybullet.GEOM_SPHERE] * _FEET + [pybullet.GEOM_BOX],
                radii=[_FOOT_RADIUS] * _FEET + [0.0],
                halfExtents=[_REST] * _FEET + [half_box],
                collisionFramePositions=[*self._foot_positions(), (0.0, 0.0, _FOOT_RADIUS)],
                physicsClientId=self._client,
            )
        )

    def _foot_positions(self) -> list[tuple[float, float, float]]:
        aside, height = self._settings.support_radius / math.sqrt(2.0), _FOOT_RADIUS - _HALF_HEIGHT
        return [(x, y, height) for x in (-aside, aside) for y in (-aside, aside)]

    def _make_tip(self, radius: float) -> int:
        sphere = pybullet.createCollisionShape(
            pybullet.GEOM_SPHERE, radius=radius, physicsClientId=self._client
        )
        return self._make_body(_TIP_MASS, sphere, self._settings.friction_pusher)

    def _make_body(self, mass: float, shape: int, friction: float) -> int:
        body = int(pybullet.createMultiBody(mass, shape, physicsClientId=self._client))
        pybullet.changeDynamics(
            body,
            -1,
            lateralFriction=friction,
            spinningFriction=0.0,
            rollingFriction=0.0,
            restitution=0.0,
            linearDamping=0.0,
            angularDamping=0.0,
            activationState=pybullet.ACTIVATION_STATE_DISABLE_SLEEPING,
            physicsClientId=self._client,
        )
        return body

    def _run(self, velocity: Pair, substeps: int) -> None:
        (cos, sin), (x, y) = self._heading, velocity
        linear = (cos * x + sin * y, cos * y - sin * x, self._lift)
        client, tip = self._client, self._tip
        for _ in range(substeps):
            pybullet.resetBaseVelocity(tip, linear, _REST, physicsClientId=client)
            pybullet.stepSimulation(client)

    def _set_axes(self, axes: Array) -> None:
        self._axes = axes
        self._heading = math.cos(axes[2]), math.sin(axes[2])

    def _follow_heading(self) -> None:
        """Turns the axes of the physics along the slider and moves their origin under it."""
        tip = self.tip_position
        axes = self.object_pose
        linear, angular = pybullet.getBaseVelocity(self._object, self._client)
        (_, _, height), orientation = pybullet.getBasePositionAndOrientation(
            self._object, self._client
        )
        back = yaw_to_quaternion(float(self._axes[2] - axes[2]))
        _, level = pybullet.multiplyTransforms(_REST, back, _REST, orientation)
        turned = [pybullet.rotateVector(back, vector) for vector in (linear, angular)]
        self._set_axes(axes)
        self._steps_left = self._follow_steps
        pybullet.resetBasePositionAndOrientation(
            self._object, (0.0, 0.0, height), level, physicsClientId=self._client
        )
        pybullet.resetBaseVelocity(self._object, *turned, physicsClientId=self._client)
        self._place_tip(tip)

    def _place_tip(self, position: Array) -> None:
        x, y = to_body(self._axes, position).tolist()
        self._place(self._tip, (x, y, _HALF_HEIGHT), _UPRIGHT)

    def _forget_contacts(self) -> None:
        """Lifts the slider off everything for a step, so that no cached contact is left."""
        self._place(self._object, _ASIDE, _UPRIGHT)
        pybullet.stepSimulation(self._client)

    def _place(
        self, body: int, position: tuple[float, ...], orientation: tuple[float, ...]
    ) -> None:
        pybullet.resetBasePositionAndOrientation(
            body, position, orientation, physicsClientId=self._client
        )
        pybullet.resetBaseVelocity(body, _REST, _REST, physicsClientId=self._client)

    def _apply_impulse(self, impulse: Array) -> None:
        force = rotation(self._axes[2]).T @ impulse / self._settings.substep
        position, _ = pybullet.getBasePositionAndOrientation(self._object, self._client)
        pybullet.applyExternalForce(
            self._object,
            -1,
            (*force.tolist(), 0.0),
            position,
            pybullet.WORLD_FRAME,
            physicsClientId=self._client,
        )
        self._impulse = None
