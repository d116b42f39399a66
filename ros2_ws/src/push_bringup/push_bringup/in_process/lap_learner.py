"""Learns from every lap of a run: the model from its pushes, the reference from its errors."""

import hashlib
import math
from dataclasses import dataclass, replace

import numpy as np
from push_core.data import PushSet
from push_core.geometry import Array, rotation
from push_gp.learn import ConeLearner, Identified, interrupted, segments
from push_gp.models import NOMINAL_DISTANCE, SmoothCone
from push_mpc.loop import FOLLOWING, Controller, Mode, PreparedModel, Tick
from push_mpc.plan import Lesson, ReferenceShift
from push_mpc.settings import MpcSettings
from push_sim.plant import Observation

from push_bringup.in_process.tables import tabulated

DISTURBED = 0.3
"""Path [m] after a disturbance whose errors do not teach the reference."""

ANOTHER_MODEL = 0.05
"""Change of the logarithm of a parameter that makes another model: errors of a lap with the old
one do not teach the reference, and the change counts as a disturbance of the next."""


WORSE = 2.0
"""Ratio to the mean error of the best lap from which the next one is driven like that again."""


@dataclass(frozen=True)
class _Driven:
    """What a lap was driven with, and how well it went.

    Attributes:
        prepared: for the controller.
        identified: the motion cone.
        shift: of the reference.
        size: mean error of the lap [m], infinite before its end.
    """

    prepared: PreparedModel
    identified: Identified
    shift: Array
    size: float


class LapLearner:
    """Follows a run and prepares what the next lap is driven with.

    Attributes:
        identified: the motion cone that each lap but the first is driven with.
    """

    def __init__(self, controller: Controller, settings: MpcSettings) -> None:
        """Follows a controller that has its first model."""
        self.identified: list[Identified] = []
        self._controller, self._settings = controller, settings
        self._laps = settings.laps
        self._lap_time = controller.track_plan.duration / settings.laps
        self._cone = ConeLearner(settings.slider, NOMINAL_DISTANCE)
        self._shift = ReferenceShift(controller.track_plan, settings.laps)
        self._quiet_from = 0.0
        self._driven: _Driven | None = None
        self._best: _Driven | None = None
        self._rows: list[Array] = []

    def observe(self, observation: Observation, tick: Tick) -> PreparedModel | None:
        """Takes one tick; what the controller should use from the next one on at a lap's end."""
        if tick.mode not in FOLLOWING or tick.reference_time <= 0.0:
            return None
        followed = float(tick.mode == Mode.TRACKING)
        pose = observation.object_pose
        self._rows.append(
            np.array([tick.reference_time, followed, *pose, *observation.tip_position])
        )
        done = len(self.identified) + 1
        if done == self._laps or tick.reference_time < done * self._lap_time:
            return None
        return self._learn()

    def _learn(self) -> PreparedModel:
        """What the next lap is driven with: what this one teaches, or what drove the best one."""
        rows, self._rows = np.array(self._rows), []
        rows[:, 4] = np.unwrap(rows[:, 4])
        errors = self._errors(rows)
        size = float(np.hypot(*errors.T).mean())
        before, after = self._cone.known, self._cone.learn(self._pushes(rows))
        if self._best is not None and size > WORSE * self._best.size:
            # a plant that changed must be able to become better than it is
            self._best = replace(self._best, size=math.inf)
            return self._drive(self._best)
        if self._driven is not None and (self._best is None or size < self._best.size):
            self._best = replace(self._driven, size=size)
        if is_another(before, after):
            self._quiet_from = rows[-1, 0] + DISTURBED / self._settings.speed
        else:
            self._teach_reference(rows, errors)
        prepared = self._prepared(after.model)
        return self._drive(_Driven(prepared, after, self._shift.shift, math.inf))

    def _drive(self, driven: '_Driven') -> PreparedModel:
        self._driven, self._shift.shift = driven, driven.shift
        self.identified.append(driven.identified)
        return driven.prepared

    def _pushes(self, rows: Array) -> PushSet:
        return segments(rows[:, 2:5], rows[:, 5:], self._settings.slider, NOMINAL_DISTANCE)

    def _errors(self, rows: Array) -> Array:
        """Errors (n, 2) of the object's position [m], in the frame of the track."""
        plan, track = self._controller.plan, self._controller.track_plan
        reference = np.array([plan.at(time)[0][:2] for time in rows[:, 0].tolist()])
        turn = float(plan.state[0, 2] - track.state[0, 2])
        return np.asarray((rows[:, 2:4] - reference) @ rotation(turn))

    def _teach_reference(self, rows: Array, errors: Array) -> None:
        times = rows[:, 0]
        broken = interrupted(rows[:, 2:5], rows[:, 5:], self._settings.slider)
        broken |= rows[:, 1] == 0.0
        teaches = (times >= self._quiet_from) & ~self._after(times, times[broken])
        self._shift.learn(times[teaches], errors[teaches])

    def _after(self, times: Array, disturbances: Array) -> np.ndarray:
        """Whether each time (n,) lies within the path that a disturbance spoils."""
        if not len(disturbances):
            return np.zeros(len(times), dtype=bool)
        last = np.searchsorted(disturbances, times, side='right') - 1
        since = np.where(last >= 0, times - disturbances[last], math.inf)
        return np.asarray(since <= DISTURBED / self._settings.speed)

    def _prepared(self, model: SmoothCone) -> PreparedModel:
        lesson = Lesson(model.slider, self._shift.shift)
        table = tabulated(model, self._settings.slider.side)
        return self._controller.prepare_model(table, lesson_id(model, lesson), lesson)


def is_another(before: Identified, after: Identified) -> bool:
    """Whether the errors under one cone say nothing about those under another one."""
    changes = (
        math.log(after.model.slider.friction_pusher / before.model.slider.friction_pusher),
        math.log(after.model.slider.support_radius / before.model.slider.support_radius),
    )
    return before.pushes == 0 or max(map(abs, changes)) > ANOTHER_MODEL


def lesson_id(model: SmoothCone, lesson: Lesson) -> str:
    """Short name of a model and what was learned beside it."""
    digest = hashlib.sha256(model.info.model_hash.encode())
    digest.update(np.ascontiguousarray(lesson.shift, '<f8').tobytes())
    return digest.hexdigest()[:12]
