"""Slider, tip and table in a physics server, in the physics axes."""

from push_core.geometry import quaternion_to_yaw, yaw_to_quaternion
from push_core.physics import GRAVITY, Pair, Slider

from push_sim.settings import WorldSettings
from push_sim.worlds.bullet.bodies import (
    HALF_HEIGHT,
    make_object,
    make_tip,
    resting_height,
    set_friction,
)
from push_sim.worlds.bullet.impact import fraction_until_contact
from push_sim.worlds.bullet.silent_pybullet import pybullet
from push_sim.worlds.bullet.snapshot import restore_server_state, server_state
from push_sim.worlds.bullet.table import UnevenTable, make_table
from push_sim.worlds.common import Axes, Outline, TableFriction, feet

_CONTACT_RANGE = 1e-3
_USUAL_STEP = 1e-3
_FAR_AWAY = (0.0, 0.0, 10.0)
_REST = (0.0, 0.0, 0.0)
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


class BulletScene:
    """The bodies and the solver; all vectors and positions are in the physics axes."""

    def __init__(self, settings: WorldSettings, slider: Slider, outline: Outline) -> None:
        self._settings, self._slider, self._outline = settings, slider, outline
        self._resting_height = resting_height(settings, slider)
        self.seed = 0
        self._uneven: UnevenTable | None = None
        self._client = pybullet.connect(pybullet.DIRECT)
        self._make()

    def close(self) -> None:
        """Ends the physics server."""
        pybullet.disconnect(self._client)

    def set_seed(self, seed: int) -> None:
        """Rebuilds everything that depends on the seed, if the seed has changed."""
        if seed == self.seed:
            return
        self.seed = seed
        if self._settings.pressure == 'random':
            pybullet.resetSimulation(physicsClientId=self._client)
            self._make()
        elif self._settings.uneven:
            self._uneven = self._uneven_table()

    def set_friction(self, settings: WorldSettings) -> None:
        """Uses settings that differ only in the coefficients of friction."""
        self._settings = settings
        set_friction(self._client, self._tip, settings.friction_pusher)
        for table in self._tables:
            set_friction(self._client, table, settings.friction_ground)
        if settings.uneven:
            self._uneven = self._uneven_table()

    def state(self) -> bytes:
        """The state of the physics server."""
        return server_state(self._client)

    def restore_state(self, state: bytes) -> None:
        """Restores a state of a scene with the same settings and seed."""
        restore_server_state(self._client, state)

    @property
    def slider(self) -> Axes:
        """Pose of the slider."""
        (x, y, _), (_, _, q_z, q_w) = self._body_pose(self._object)
        return Axes(x, y, quaternion_to_yaw(q_z, q_w))

    @property
    def tip(self) -> Pair:
        """Centre of the tip [m]."""
        (x, y, _), _ = self._body_pose(self._tip)
        return x, y

    @property
    def contact(self) -> bool:
        """Whether a normal force acted between tip and slider in the last time step."""
        points = pybullet.getContactPoints(self._tip, self._object, physicsClientId=self._client)
        normal_force = 9
        return any(point[normal_force] > 0.0 for point in points)

    @property
    def penetration(self) -> float:
        """Deepest overlap [m] of any two bodies in the last time step."""
        distance = 8
        points = pybullet.getContactPoints(physicsClientId=self._client)
        return max((-float(point[distance]) for point in points), default=0.0)

    def place_slider(self, position: Pair, theta: float) -> None:
        """Places the slider at rest."""
        self._place(self._object, (*position, self._resting_height), theta)

    def place_tip(self, position: Pair) -> None:
        """Places the tip at rest."""
        self._place(self._tip, (*position, HALF_HEIGHT), 0.0)

    def clear_contacts(self) -> None:
        """Steps once with the slider far away, so that no cached contact is left."""
        self._place(self._object, _FAR_AWAY, 0.0)
        pybullet.stepSimulation(self._client)

    def apply_impulse(self, impulse: Pair) -> None:
        """Applies an impulse [N s] to the slider's centre in the next time step."""
        x, y = (part / self._settings.substep for part in impulse)
        centre, _ = self._body_pose(self._object)
        pybullet.applyExternalForce(
            self._object, -1, (x, y, 0.0), centre, pybullet.WORLD_FRAME, self._client
        )

    def update_friction(self, axes: Axes) -> None:
        """Sets the friction of an uneven table for the next step; `axes` are the physics axes."""
        if self._uneven is not None:
            linear, angular = pybullet.getBaseVelocity(self._object, self._client)
            self._uneven.update(axes, self.slider, linear[:2], angular[2])

    def step(self, velocity: Pair) -> None:
        """One time step with a velocity [m/s] of the tip."""
        linear = (velocity[0], velocity[1], self._lift)
        pybullet.resetBaseVelocity(self._tip, linear, _REST, self._client)
        pybullet.stepSimulation(self._client)

    def step_cut_at_contact(self, velocity: Pair) -> None:
        """One time step, cut in two if the tip meets the slider within it."""
        substep = self._settings.substep
        fraction = self._fraction_until_contact(velocity, substep)
        if fraction == 1.0:
            self.step(velocity)
            return
        for cut in (fraction * substep, (1.0 - fraction) * substep):
            self._set_substep(cut)
            self.step(velocity)
        self._set_substep(substep)

    def move_axes_under_slider(self) -> Axes:
        """Moves the axes to the pose of the slider; returns this pose in the old axes."""
        client, slider = self._client, self.slider
        (_, _, height), (q_x, q_y, q_z, q_w) = self._body_pose(self._object)
        linear, angular = pybullet.getBaseVelocity(self._object, client)
        tip = slider.point_from_world(self.tip)
        _, _, z, w = yaw_to_quaternion(-slider.theta)
        level = (w * q_x - z * q_y, w * q_y + z * q_x, w * q_z + z * q_w, w * q_w - z * q_z)
        pybullet.resetBasePositionAndOrientation(self._object, (0.0, 0.0, height), level, client)
        pybullet.resetBaseVelocity(
            self._object,
            (*slider.vector_from_world(linear[:2]), linear[2]),
            (*slider.vector_from_world(angular[:2]), angular[2]),
            client,
        )
        pybullet.resetBasePositionAndOrientation(self._tip, (*tip, HALF_HEIGHT), _UPRIGHT, client)
        return slider

    def _make(self) -> None:
        """Makes all bodies in an empty physics server."""
        client, settings, slider = self._client, self._settings, self._slider
        self._set_up_solver()
        self._tables = make_table(client, settings)
        self._feet = feet(settings, slider.side, self.seed)
        self._object = make_object(client, slider, self._feet)
        self._tip = make_tip(client, settings, slider)
        for table in self._tables:
            pybullet.setCollisionFilterPair(self._tip, table, -1, -1, 0, physicsClientId=client)
        if settings.uneven:
            self._uneven = self._uneven_table()

    def _uneven_table(self) -> UnevenTable:
        friction = TableFriction(self._settings, self.seed)
        return UnevenTable(self._client, self._tables, self._feet, friction)

    def _set_up_solver(self) -> None:
        settings, client = self._settings, self._client
        # impulses are proportional to the step: this keeps the error of the forces
        residual = settings.solver_residual * (settings.substep / _USUAL_STEP) ** 2
        pybullet.setGravity(0.0, 0.0, -GRAVITY, physicsClientId=client)
        pybullet.setPhysicsEngineParameter(
            numSolverIterations=settings.solver_iterations,
            solverResidualThreshold=residual,
            contactBreakingThreshold=_CONTACT_RANGE,
            enableConeFriction=1,
            deterministicOverlappingPairs=1,
            physicsClientId=client,
        )
        self._set_substep(settings.substep)

    def _set_substep(self, substep: float) -> None:
        pybullet.setPhysicsEngineParameter(fixedTimeStep=substep, physicsClientId=self._client)
        # cancels the vertical speed that gravity adds in a step, so that the tip keeps its height
        self._lift = GRAVITY * substep

    def _fraction_until_contact(self, velocity: Pair, substep: float) -> float:
        slider, (x, y) = self.slider, self.tip
        (u, v, _), (_, _, turn_rate) = pybullet.getBaseVelocity(self._object, self._client)
        later = Axes(
            slider.x + u * substep, slider.y + v * substep, slider.theta + turn_rate * substep
        )
        end = (x + velocity[0] * substep, y + velocity[1] * substep)
        return fraction_until_contact(
            self._outline, slider.point_from_world((x, y)), later.point_from_world(end)
        )

    def _body_pose(self, body: int) -> tuple[tuple[float, ...], tuple[float, ...]]:
        position, orientation = pybullet.getBasePositionAndOrientation(body, self._client)
        return position, orientation

    def _place(self, body: int, position: tuple[float, float, float], theta: float) -> None:
        turn = yaw_to_quaternion(theta)
        pybullet.resetBasePositionAndOrientation(body, position, turn, self._client)
        pybullet.resetBaseVelocity(body, _REST, _REST, self._client)
