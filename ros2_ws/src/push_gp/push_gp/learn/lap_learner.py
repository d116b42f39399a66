"""Learns from every lap of a run: the model from its pushes, the reference from its errors."""

import hashlib
import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import Array
from push_core.physics import Slider

from push_gp.learn.cone_learner import ConeLearner
from push_gp.learn.identification import Identified
from push_gp.learn.laps import MeasuredLap
from push_gp.learn.reference_shift import ReferenceShift
from push_gp.learn.segments import interrupted, segments
from push_gp.learn.timed_reference import TimedReference
from push_gp.models import NOMINAL_DISTANCE, SmoothCone

DISTURBED = 0.3
"""Path [m] after a disturbance whose errors do not teach the reference."""

ANOTHER_MODEL = 0.05
"""Change of the logarithm of a parameter that makes another model: errors of a lap with the old
one do not teach the reference, and the change counts as a disturbance of the next."""

WORSE = 2.0
"""Ratio to the mean error of the best lap from which the next one is driven like that again."""


def _no_shift() -> Array:
    return np.zeros((0, 2))


@dataclass(frozen=True)
class Learned:
    """What laps have taught.

    Attributes:
        identified: the motion cone; from no pushes, nothing is known.
        track, speed: of the reference that the shift is of.
        shift: (n, 2) of it [m] at every sample of a lap, in the frame of its start.
    """

    identified: Identified
    track: str = ''
    speed: float = 0.0
    shift: Array = field(default_factory=_no_shift)

    @property
    def model(self) -> SmoothCone | None:
        """The identified cone, None if nothing is known."""
        return self.identified.model if self.identified.pushes else None

    def lesson_id(self, base: str) -> str:
        """Short name of model and shift; `base` where nothing is learned.

        Args:
            base: id of the model that serves until a cone is identified.
        """
        model_id = self.model.info.model_id if self.model else base
        if not (self.model or self.shift.any()):
            return model_id
        digest = hashlib.sha256(model_id.encode())
        digest.update(np.ascontiguousarray(self.shift, '<f8').tobytes())
        return digest.hexdigest()[:12]

    def is_of(self, reference: TimedReference) -> bool:
        """Whether the shift is of this reference."""
        same = (self.track, self.speed) == (reference.track, reference.speed)
        return same and len(self.shift) == reference.samples


@dataclass(frozen=True)
class _Driven:
    """What a lap is driven with, and the mean error of that lap [m], infinite before its end."""

    learned: Learned
    size: float = math.inf


class LapLearner:
    """Learns from one lap after the other, also of several runs."""

    def __init__(self, slider: Slider, base: str, start: Learned | None = None) -> None:
        """Begins with what is known.

        Args:
            slider: nominal one.
            base: id of the model that serves until a cone is identified.
            start: what laps before have taught.
        """
        self._slider, self._base = slider, base
        self._cone = ConeLearner(slider, NOMINAL_DISTANCE, start.identified if start else None)
        self._driven = _Driven(start or Learned(self._cone.known))
        self._best: _Driven | None = None
        self._before = self._driven
        self._changed = False
        self._reference: TimedReference | None = None

    @property
    def known(self) -> Learned:
        """What the next lap is driven with."""
        return self._driven.learned

    def begin(self, reference: TimedReference) -> None:
        """A run begins, at rest; a shift of another reference is forgotten."""
        self._reference = reference
        self._before, self._changed = self._driven, False
        self._shift = ReferenceShift(reference)
        if self.known.is_of(reference):
            self._shift.shift = self.known.shift
        if self.known.is_of(reference) or not len(self.known.shift):
            return
        self._best = None
        self._driven = _Driven(Learned(self.known.identified))

    def learn(self, lap: MeasuredLap) -> Learned:
        """What the next lap is driven with: what this one teaches, or what drove the best one."""
        assert self._reference is not None
        errors = self._reference.errors(lap.time, lap.object_pose[:, :2])
        size = float(np.hypot(*errors.T).mean())
        before = self._cone.known
        after = self._cone.learn(
            segments(lap.object_pose, lap.tip, self._slider, NOMINAL_DISTANCE)
        )
        if self._best is not None and size > WORSE * self._best.size:
            # a plant that changed must be able to become better than it is
            self._best = replace(self._best, size=math.inf)
            best = self._best.learned.identified
            self._drive(self._best, is_another(self.known.identified, best))
            return self.known
        if self.known.model and (self._best is None or size < self._best.size):
            self._best = replace(self._driven, size=size)
        another = is_another(before, after)
        if not another:
            self._teach_reference(lap, errors)
        shift, reference = self._shift.shift, self._reference
        self._drive(_Driven(Learned(after, reference.track, reference.speed, shift)), another)
        return self.known

    def _drive(self, driven: _Driven, changed: bool) -> None:
        self._before, self._driven, self._changed = self._driven, driven, changed
        self._shift.shift = driven.learned.shift

    def _teach_reference(self, lap: MeasuredLap, errors: Array) -> None:
        broken = interrupted(lap.object_pose, lap.tip, self._slider) | ~lap.tracking
        driven = lap.driven == self.known.lesson_id(self._base)
        if self._changed:
            # the change disturbs whatever follows it
            broken[np.flatnonzero(driven)[:1]] = True
        else:
            # in real time a lesson comes in mid-lap; until then the one before it drives
            early = (lap.driven == self._before.learned.lesson_id(self._base)) & ~driven
            errors = errors.copy()
            errors[early] += self._shift.driven_by(self._before.learned.shift, lap.time[early])
            driven |= early
        teaches = driven & ~self._after(lap.time, lap.time[broken])
        self._shift.learn(lap.time[teaches], errors[teaches])

    def _after(self, times: Array, disturbances: Array) -> NDArray[np.bool_]:
        """Whether each time (n,) lies within the path that a disturbance spoils."""
        assert self._reference is not None
        if not len(disturbances):
            return np.zeros(len(times), dtype=bool)
        last = np.searchsorted(disturbances, times, side='right') - 1
        since = np.where(last >= 0, times - disturbances[last], math.inf)
        return np.asarray(since <= DISTURBED / self._reference.speed)


def is_another(before: Identified, after: Identified) -> bool:
    """Whether the errors under one cone say nothing about those under another one."""
    changes = (
        math.log(after.model.slider.friction_pusher / before.model.slider.friction_pusher),
        math.log(after.model.slider.support_radius / before.model.slider.support_radius),
    )
    return before.pushes == 0 or max(map(abs, changes)) > ANOTHER_MODEL
