"""Learns from a run: the model from pushes, the reference from the errors of whole laps."""

import hashlib
import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from push_core.geometry import Array
from push_core.physics import INERTIA_FROM, Slider

from push_gp.learn.cone_learner import FEWEST, ConeLearner, log_ratio
from push_gp.learn.identification import Identified
from push_gp.learn.laps import MeasuredLap
from push_gp.learn.reference_shift import ReferenceShift
from push_gp.learn.segments import interrupted, noise_of, segments
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
    """What a lap is driven with, and the mean error of that lap [m]."""

    learned: Learned
    size: float


class LapLearner:
    """Learns from one lap after the other, also of several runs, and from pieces of them."""

    def __init__(self, slider: Slider, base: str, start: Learned | None = None) -> None:
        """Begins with what is known.

        Args:
            slider: nominal one.
            base: id of the model that serves until a cone is identified.
            start: what laps before have taught.
        """
        self._slider, self._base = slider, base
        self._cone = ConeLearner(slider, NOMINAL_DISTANCE, start.identified if start else None)
        self.known = start or Learned(self._cone.known)
        self._lessons: dict[str, Learned] = {}
        self._begin_lap(self.known)
        self._best: _Driven | None = None
        self._reference: TimedReference | None = None

    def begin(self, reference: TimedReference) -> None:
        """A run begins, at rest; a shift of another reference is forgotten."""
        self._reference = reference
        fast = reference.speed >= INERTIA_FROM
        self._cone.speed = reference.speed if fast else 0.0
        self._begin_lap(self.known)
        self._shift = ReferenceShift(reference)
        if self.known.is_of(reference):
            self._shift.start_from(self.known.shift)
        elif len(self.known.shift):
            self._best = None
            self._begin_lap(Learned(self.known.identified))

    def refine(self, piece: MeasuredLap) -> Learned:
        """What is driven after a piece of a lap; one with a disturbance teaches nothing."""
        broken = interrupted(piece.object_pose, piece.tip, self._slider) | ~piece.tracking
        if broken.any():
            return self.known
        before = self._cone.known
        changed = self._cone.refine(
            segments(piece.object_pose, piece.tip, self._slider, NOMINAL_DISTANCE)
        )
        if changed:
            self._since, self._best = float(piece.time[0]), None
        if self._cone.known is not before:
            self._take(replace(self.known, identified=self._cone.known))
        return self.known

    def learn(self, lap: MeasuredLap) -> Learned:
        """What the next lap is driven with: what this one teaches, or what drove the best one."""
        assert self._reference is not None
        errors = self._reference.errors(lap.time, lap.object_pose[:, :2])
        size = float(np.hypot(*errors.T).mean())
        same = lap.time >= self._since
        pushes = segments(lap.object_pose[same], lap.tip[same], self._slider, NOMINAL_DISTANCE)
        after = self._cone.learn(pushes)
        if self._best is not None and size > WORSE * self._best.size:
            # a plant that changed must be able to become better than it is
            self._best = replace(self._best, size=math.inf)
            self._shift.start_from(self._best.learned.shift)
            return self._begin_lap(self._best.learned)
        if self._best is None or size < self._best.size:
            self._best = _Driven(self.known, size)
        if len(pushes) >= FEWEST:
            self._teach_reference(lap, errors, after)
        shift, reference = self._shift.shift, self._reference
        return self._begin_lap(Learned(after, reference.track, reference.speed, shift))

    def _begin_lap(self, learned: Learned) -> Learned:
        """A lap begins; in real time what drove the last one goes on for a while."""
        self._before, self._since = self.known, -math.inf
        self._lessons.clear()
        self._take(self.known)
        self._take(learned)
        return learned

    def _take(self, learned: Learned) -> None:
        self.known = learned
        self._lessons[learned.lesson_id(self._base)] = learned

    def _teach_reference(self, lap: MeasuredLap, errors: Array, after: Identified) -> None:
        """Teaches from the ticks whose model was much the same as the one from now on."""
        broken = interrupted(lap.object_pose, lap.tip, self._slider) | ~lap.tracking
        # what follows another model is disturbed by it
        broken[0] |= is_another(self._before.identified, after)
        teaches = np.zeros(len(lap.time), dtype=bool)
        drove: list[tuple[Learned, NDArray[np.bool_]]] = []
        for lesson_id in np.unique(lap.driven):
            lesson = self._lessons.get(str(lesson_id))
            rows = lap.driven == lesson_id
            if lesson is None or is_another(lesson.identified, after):
                broken |= rows
                continue
            drove.append((lesson, rows))
            teaches |= rows
        teaches &= ~self._after(lap.time, lap.time[broken])
        self._shift.trust(errors[teaches], noise_of(lap.object_pose, lap.tip))
        errors = errors.copy()
        for lesson, rows in drove:
            # in real time a lesson comes in mid-lap; until then the one before it drives
            errors[rows] += self._shift.driven_by(lesson.shift, lap.time[rows])
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
    if not (before.pushes and after.pushes):
        return before.pushes != after.pushes
    return float(np.abs(log_ratio(before, after)).max()) > ANOTHER_MODEL
