"""Disturbances as the paper makes them: object or tip is displaced, or the object is knocked."""

import math
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array, rotation

from push_sim.settings import PerturbationSettings
from push_sim.worlds.common import World


class Kind(IntEnum):
    """What happens; the numbers are those of push_msgs/Perturbation."""

    NORMAL = 0
    TANGENTIAL = 1
    IMPULSE = 2


LARGEST_MAGNITUDE = 1.0
"""In m or N s."""

DEFAULT_MAGNITUDE = {Kind.NORMAL: 0.03, Kind.TANGENTIAL: 0.02, Kind.IMPULSE: 0.3}


@dataclass(frozen=True)
class Perturbation:
    """One disturbance.

    Attributes:
        kind: NORMAL moves the object away from the tip, along the inward normal of the pushed
            face; TANGENTIAL moves the tip along the face, so that p_y grows by the magnitude;
            IMPULSE knocks its centre.
        magnitude: [m], or [N s] of an impulse.
        angle: world direction of an impulse [rad].

    Raises:
        InputError: the size is out of range, or would move the object into the tip.
    """

    kind: Kind
    magnitude: float
    angle: float = 0.0

    def __post_init__(self) -> None:
        low = 0.0 if self.kind == Kind.NORMAL else -LARGEST_MAGNITUDE
        if not low <= self.magnitude <= LARGEST_MAGNITUDE or not math.isfinite(self.angle):
            raise InputError(
                f'magnitude of a {self.kind.name.lower()} perturbation is {self.magnitude:g}, '
                f'must be between {low:g} and {LARGEST_MAGNITUDE:g}, its angle finite'
            )

    def direction(self, object_pose: Array) -> Array:
        """World unit vector (2,) of the displacement or the knock, for an object pose (3,)."""
        if self.kind == Kind.IMPULSE:
            return np.array([math.cos(self.angle), math.sin(self.angle)])
        body = {Kind.NORMAL: (1.0, 0.0), Kind.TANGENTIAL: (0.0, 1.0)}[self.kind]
        return np.asarray(rotation(object_pose[2]) @ np.array(body))


@dataclass(frozen=True)
class Disturbance:
    """A perturbation as it happened.

    Attributes:
        time: plant time [s].
        kind: what happened.
        magnitude: [m], or [N s] of an impulse.
        direction: world unit vector (2,).
    """

    time: float
    kind: Kind
    magnitude: float
    direction: Array


def disturb(world: World, perturbation: Perturbation, time: float) -> Disturbance:
    """Applies a perturbation to a world at a plant time [s]."""
    pose = world.object_pose
    direction = perturbation.direction(pose)
    shift = perturbation.magnitude * direction
    match perturbation.kind:
        case Kind.IMPULSE:
            world.push_object(shift)
        case Kind.TANGENTIAL:
            world.place_tip(world.tip_position + shift)
        case Kind.NORMAL:
            world.place_object(pose + np.array([*shift, 0.0]))
    return Disturbance(time, perturbation.kind, perturbation.magnitude, direction)


class Schedule:
    """The one disturbance that the settings ask for, and when it is due."""

    def __init__(self, settings: PerturbationSettings) -> None:
        self._delay = settings.time
        self._perturbation = _from_settings(settings)
        self.reset()

    def reset(self) -> None:
        """The disturbance has yet to come."""
        self._left = self._perturbation
        self._start: float | None = None

    def motion_commanded(self, time: float) -> None:
        """Tells when [s] a non-zero command came; the first one counts."""
        if self._start is None:
            self._start = time

    def due(self, time: float) -> Perturbation | None:
        """The disturbance, once, as soon as a plant time [s] has reached its moment."""
        started = self._start is not None and time - self._start >= self._delay
        if self._left is None or not (started or self._delay == 0.0):
            return None
        left, self._left = self._left, None
        return left


def _from_settings(settings: PerturbationSettings) -> Perturbation | None:
    if settings.kind == 'none':
        return None
    kind = Kind[settings.kind.upper()]
    return Perturbation(kind, settings.magnitude or DEFAULT_MAGNITUDE[kind], settings.angle)
