"""The plant: world, robot, cameras and perturbations, one period at a time."""

import copy
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array, to_body, to_world
from push_core.physics import Slider

from push_sim.plant.driver import Driver
from push_sim.plant.perturbation import (
    AppliedPerturbation,
    Perturbation,
    Schedule,
    apply_perturbation,
)
from push_sim.plant.sensor import Observation, Sensor, nothing_seen
from push_sim.settings import PERIOD, SimSettings, StartOffset, WorldSettings
from push_sim.worlds import make_world
from push_sim.worlds.common import Outline

_NANOSECOND = 1e-9
_TOUCHING = 1e-4  # [m]; positions that are measured or typed in are no better
_NOT_COPIED = ('_settings', '_world')


@dataclass(frozen=True)
class PlantSnapshot:
    """The complete state of a `Plant`; independent of the plant, and can be pickled.

    Attributes:
        settings: settings of the plant, and its slider.
        world: snapshot of the world.
        parts: all other attributes, in one deep copy so that shared objects stay shared.
    """

    settings: tuple[SimSettings, Slider]
    world: object
    parts: dict[str, Any]


class Plant:
    """World, robot and cameras behind the topics, without ROS.

    Plant time is a whole number of nanoseconds and begins at `START`: a stamp of zero means 'not
    set' in ROS, and the first exposure is one latency before the first period.
    """

    period = PERIOD
    START = 1.0

    def __init__(self, settings: SimSettings, slider: Slider) -> None:
        self._settings = settings, slider
        self._world = make_world(settings.world, slider)
        self._driver = Driver(
            settings.actuator, settings.command_timeout, settings.command_loss, settings.limits
        )
        self._sensor = Sensor(settings.sensor)
        self._schedule = Schedule(settings.perturbation)
        self._substeps = settings.world.substeps
        self._latency = settings.latency_substeps
        self._applied: list[AppliedPerturbation] = []
        self._ticks = 0

    def reset(self, object_pose: Array, tip_position: Array, seed: int) -> Observation:
        """Puts the plant into a state that does not depend on anything before.

        Args:
            object_pose: (3,) x [m], y [m], theta [rad]; the object is placed there except for
                the settings' `start_offset`.
            tip_position: (2,) centre of the tip [m].
            seed: seed of everything random, not negative.

        Returns:
            The first observation, of the object at rest.

        Raises:
            InputError: a value is not finite, the seed is negative, or the tip is inside the
                object.
        """
        _check_start(object_pose, tip_position, seed)
        _check_overlap(self.slider, object_pose, tip_position)
        self._ticks = 0
        self._world.reset(self._placed(object_pose, tip_position), tip_position, seed)
        random = np.random.default_rng(seed)
        self._driver.reset(random.spawn(1)[0])
        self._schedule.reset()
        self._sensor.reset(random)
        self._applied.clear()
        self._perturb_if_due()
        self._pictures = 0
        self._schedule_picture()
        self._expose_until(0)
        return self._sensor.show_first()

    def command(self, velocity: Array, arrival: float) -> None:
        """Sends a tip velocity (2,) [m/s] to the driver; it arrives at a plant time [s]."""
        if any(velocity):
            self._schedule.motion_commanded(arrival)
        self._driver.command(velocity, arrival, self.tip_position)

    def change(self, settings: SimSettings) -> None:
        """Uses other friction, sensor, perturbation, losses and start offset from now on.

        Raises:
            InputError: another setting differs, for which a new plant has to be made.
        """
        old, slider = self._settings
        world = _with_friction_of(old.world, settings.world)
        unchanged = world, settings.actuator, settings.sensor.grid
        if unchanged != (old.world, old.actuator, old.sensor.grid):
            raise InputError(
                'actuator, latency, rate, and of the world all but friction cannot change'
            )
        self._settings = settings, slider
        if settings.world != old.world:
            self._world.set_friction(
                settings.world.friction_ground, settings.world.friction_pusher
            )
        self._sensor.change(settings.sensor)
        self._driver.change(settings.command_timeout, settings.command_loss)
        if settings.perturbation != old.perturbation:
            self._schedule.change(settings.perturbation)

    def step(self) -> Observation | None:
        """Advances one period; returns the picture published then, None without one."""
        self._perturb_if_due()
        start, duration, done = self.time, self._substep, 0
        while done < self._substeps:
            until = min(self._substeps, self._exposure - self._ticks * self._substeps)
            times = (start + substep * duration for substep in range(done, until))
            self._world.follow([self._driver.advance(time, duration) for time in times])
            self._expose_until(until)
            done = until
        self._ticks += 1
        return self._sensor.show()

    def without_picture(self) -> Observation:
        """Stands for a picture in a period without one; no exposure has its time."""
        return nothing_seen(self.time - 0.5 * self._substep)

    def step_until_seen(self) -> Observation:
        """Advances to the next picture that is not lost."""
        while True:
            observation = self.step()
            if observation is not None:
                return observation

    def perturb(self, perturbation: Perturbation) -> AppliedPerturbation:
        """Applies a perturbation now."""
        applied = apply_perturbation(self._world, perturbation, self.time)
        self._applied.append(applied)
        return applied

    def take_perturbations(self) -> list[AppliedPerturbation]:
        """The perturbations since the last call, in order of time."""
        taken, self._applied = self._applied, []
        return taken

    def snapshot(self) -> PlantSnapshot:
        """The complete state, for `restore`; taking it has no effect on the plant."""
        parts = {name: part for name, part in vars(self).items() if name not in _NOT_COPIED}
        return PlantSnapshot(self._settings, self._world.snapshot(), copy.deepcopy(parts))

    def restore(self, snapshot: PlantSnapshot) -> None:
        """Restores a snapshot of this plant, or of another one with the same settings.

        The plant then continues exactly as after the snapshot, to the last bit.

        Raises:
            InputError: the plant of the snapshot has other settings.
        """
        if snapshot.settings != self._settings:
            raise InputError('a snapshot can only be restored in a plant with the same settings')
        self._world.restore(snapshot.world)
        vars(self).update(copy.deepcopy(snapshot.parts))

    def close(self) -> None:
        """Frees the resources of the world."""
        self._world.close()

    @property
    def time(self) -> float:
        """Plant time [s]."""
        return self._time(0)

    @property
    def slider(self) -> Slider:
        """The pushed object."""
        return self._settings[1]

    @property
    def true_slider(self) -> Slider:
        """The pushed object with the size that it really has."""
        settings, slider = self._settings
        return replace(slider, side=slider.side * (1.0 + settings.world.size_error))

    @property
    def object_pose(self) -> Array:
        """True pose (3,) of the object: x [m], y [m], theta [rad]."""
        return self._world.object_pose

    @property
    def tip_position(self) -> Array:
        """True centre (2,) of the tip [m]."""
        return self._world.tip_position

    @property
    def tip_velocity(self) -> Array:
        """True velocity (2,) of the tip [m/s]."""
        return self._driver.velocity

    @property
    def contact(self) -> bool:
        """Whether the tip presses on the object."""
        return self._world.contact

    @property
    def braking(self) -> bool:
        """Whether the driver's watchdog is braking or holding the tip."""
        return self._driver.braking

    @property
    def limited(self) -> Mapping[str, int]:
        """Number of commands that each of the driver's limits changed."""
        return self._driver.limited

    @property
    def _substep(self) -> float:
        return PERIOD / self._substeps

    def _placed(self, object_pose: Array, tip_position: Array) -> Array:
        """The object pose (3,) with the start offset, moved off the tip where they overlap."""
        settings, slider = self._settings
        offset = settings.start_offset
        if offset == StartOffset():
            return object_pose
        x, y = to_world(object_pose, np.array([offset.x, offset.y])).tolist()
        pose = x, y, float(object_pose[2]) + offset.theta
        tip = float(tip_position[0]), float(tip_position[1])
        return np.array(Outline(slider.side, slider.tip_radius).without_overlap(pose, tip))

    def _time(self, substep: int) -> float:
        """Plant time [s] at a substep of the current period."""
        elapsed = (self._ticks * self._substeps + substep) * self._substep
        return round((self.START + elapsed) / _NANOSECOND) * _NANOSECOND

    def _schedule_picture(self) -> None:
        due = self._settings[0].sensor.due(self._pictures) * self._substeps
        self._exposure = due - self._latency - self._sensor.extra_delay(self._substep)

    def _expose_until(self, substep: int) -> None:
        """Takes the pictures that are due by a substep of the current period."""
        period_start = self._ticks * self._substeps
        while self._exposure <= period_start + substep:
            time = self._time(self._exposure - period_start)
            self._sensor.expose(time, self.object_pose, self.tip_position)
            self._pictures += 1
            self._schedule_picture()

    def _perturb_if_due(self) -> None:
        due = self._schedule.due(self.time)
        if due is not None:
            self.perturb(due)


def _with_friction_of(other: WorldSettings, settings: WorldSettings) -> WorldSettings:
    ground, pusher = other.friction_ground, other.friction_pusher
    return replace(settings, friction_ground=ground, friction_pusher=pusher)


def _check_overlap(slider: Slider, object_pose: Array, tip_position: Array) -> None:
    x, y = to_body(object_pose, tip_position).tolist()
    depth = -Outline(slider.side, slider.tip_radius).gap(x, y)
    if depth > _TOUCHING:
        raise InputError(
            f'a reset would put the tip {1e3 * depth:.1f} mm inside the object; the tip touches '
            f'it {1e3 * -slider.tip_x:.2f} mm from its centre'
        )


def _check_start(object_pose: Array, tip_position: Array, seed: int) -> None:
    if np.shape(object_pose) != (3,) or np.shape(tip_position) != (2,):
        raise InputError('a reset takes an object pose [x, y, theta] and a tip position [x, y]')
    if not np.isfinite([*object_pose, *tip_position]).all():
        raise InputError('a reset takes finite numbers')
    if seed < 0:
        raise InputError(f'parameter seed is {seed}, must not be negative')
