"""Perturbations of a lap: the object or the tip is displaced, or the object gets an impulse."""

import math
from dataclasses import dataclass

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array, rotation

from push_sim.settings import PerturbationKind, PerturbationSettings
from push_sim.worlds.common import World

_LARGEST_MAGNITUDE = 1.0
_DEFAULT_MAGNITUDE = {
    PerturbationKind.NORMAL: 0.03,
    PerturbationKind.TANGENTIAL: 0.02,
    PerturbationKind.IMPULSE: 0.3,
}


@dataclass(frozen=True)
class Perturbation:
    """One perturbation.

    Attributes:
        kind: NORMAL moves the object away from the tip, along the inward normal of the pushed
            face; TANGENTIAL moves the tip along the face, so that p_y grows by the magnitude;
            IMPULSE acts on the object's centre.
        magnitude: [m], or [N s] for an impulse.
        angle: direction of an impulse in the world [rad].

    Raises:
        InputError: the magnitude is out of range, or would move the object into the tip.
    """

    kind: PerturbationKind
    magnitude: float
    angle: float = 0.0

    def __post_init__(self) -> None:
        low = 0.0 if self.kind == PerturbationKind.NORMAL else -_LARGEST_MAGNITUDE
        if not low <= self.magnitude <= _LARGEST_MAGNITUDE or not math.isfinite(self.angle):
            raise InputError(
                f'magnitude of a {self.kind.name.lower()} perturbation is {self.magnitude:g}, '
                f'must be between {low:g} and {_LARGEST_MAGNITUDE:g}, its angle finite'
            )

    def direction(self, object_pose: Array) -> Array:
        """Unit vector (2,) of the displacement or impulse in the world, at an object pose (3,)."""
        if self.kind == PerturbationKind.IMPULSE:
            return np.array([math.cos(self.angle), math.sin(self.angle)])
        normal = self.kind == PerturbationKind.NORMAL
        body = np.array([1.0, 0.0] if normal else [0.0, 1.0])
        return np.asarray(rotation(object_pose[2]) @ body)


@dataclass(frozen=True)
class AppliedPerturbation:
    """A perturbation that has been applied.

    Attributes:
        time: plant time [s].
        kind: its kind.
        magnitude: [m], or [N s] for an impulse.
        direction: unit vector (2,) in the world.
    """

    time: float
    kind: PerturbationKind
    magnitude: float
    direction: Array


def apply_perturbation(
    world: World, perturbation: Perturbation, time: float
) -> AppliedPerturbation:
    """Applies a perturbation to a world at a plant time [s]."""
    pose = world.object_pose
    direction = perturbation.direction(pose)
    shift = perturbation.magnitude * direction
    match perturbation.kind:
        case PerturbationKind.IMPULSE:
            world.push_object(shift)
        case PerturbationKind.TANGENTIAL:
            world.place_tip(world.tip_position + shift)
        case PerturbationKind.NORMAL:
            world.place_object(pose + np.array([*shift, 0.0]))
    return AppliedPerturbation(time, perturbation.kind, perturbation.magnitude, direction)


class Schedule:
    """Decides when the perturbation of the settings is due."""

    def __init__(self, settings: PerturbationSettings) -> None:
        self.change(settings)
        self.reset()

    def change(self, settings: PerturbationSettings) -> None:
        """Schedules another perturbation; one whose time is over already is due at once."""
        self._delay = settings.time
        self._perturbation = self._pending = _from_settings(settings)

    def reset(self) -> None:
        """Starts again: the perturbation has not happened yet."""
        self._pending = self._perturbation
        self._start: float | None = None

    def motion_commanded(self, time: float) -> None:
        """Takes the time [s] of a non-zero command; only the first one counts."""
        if self._start is None:
            self._start = time

    def due(self, time: float) -> Perturbation | None:
        """The perturbation, once, as soon as the plant time [s] reaches its moment."""
        started = self._start is not None and time - self._start >= self._delay
        if self._pending is None or not (started or self._delay == 0.0):
            return None
        pending, self._pending = self._pending, None
        return pending


def _from_settings(settings: PerturbationSettings) -> Perturbation | None:
    if settings.kind == 'none':
        return None
    kind = PerturbationKind[settings.kind.upper()]
    return Perturbation(kind, settings.magnitude or _DEFAULT_MAGNITUDE[kind], settings.angle)
