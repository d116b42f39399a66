"""Lets laps of a controller in this process teach what follows, as gp_server and mpc_node do."""

from pathlib import Path

import numpy as np
from builtin_interfaces.msg import Time
from push_gp.learn import (
    LapCollector,
    LapLearner,
    Learned,
    Measured,
    MeasuredLap,
    TimedReference,
    read_lesson,
)
from push_gp.models import ModelInfo, PushModel
from push_gp.server.conversions import lesson_message
from push_mpc.loop import FOLLOWING, Controller, Mode, Tick
from push_mpc.node import conversions
from push_mpc.plan import Plan
from push_mpc.settings import MpcSettings
from push_msgs.msg import Lesson
from push_sim.plant import Observation

from push_bringup.in_process.tables import tabulated
from push_bringup.setup import CellParameters


class School:
    """Follows a run, learns, and prepares what is driven next.

    Attributes:
        driven: what the end of each lap was driven with.
        lessons: what was taught, after each piece and each lap.
        messages: the same, as gp_server announces them.
    """

    def __init__(
        self, controller: Controller, parameters: CellParameters, model: PushModel
    ) -> None:
        """Follows a controller; its first model is that of the first lesson."""
        mpc = self._settings = parameters.mpc
        self._controller, self._model = controller, model
        lesson, slider = parameters.gp.lesson, parameters.gp.slider
        start = read_lesson(Path(lesson), slider) if lesson else None
        self._learner = LapLearner(slider, model.info.model_id, start)
        self._collector = LapCollector(
            controller.track_plan.duration / mpc.laps, mpc.laps, mpc.speed
        )
        self._taught = (0, 0)
        self._begun = False
        self.driven: list[Learned] = []
        self.lessons: list[Learned] = []
        self.messages: list[Lesson] = []
        self._next: Lesson | None = None
        self._announce(0, 0)

    @property
    def models(self) -> list[ModelInfo]:
        """The model of each lesson."""
        return [(each.model or self._model).info for each in self.lessons]

    def observe(self, observation: Observation, tick: Tick) -> None:
        """Takes one tick, and learns at the end of a piece or a lap."""
        if tick.mode not in FOLLOWING or tick.reference_time <= 0.0:
            return
        piece, lap = self._collector.add(
            Measured(
                tick.reference_time,
                tick.mode == Mode.TRACKING,
                observation.object_pose,
                observation.tip_position,
                self._controller.model_id,
            )
        )
        if piece is not None:
            self._begin()
            self._learner.refine(piece)
            self._announce(0, 1)
        if lap is not None:
            self._learn(lap)

    def use_lesson(self) -> None:
        """Lets the controller use what is new; between two ticks."""
        if self._next is None:
            return
        message, self._next = self._next, None
        if message.lesson_id == self._controller.model_id:
            return
        table = tabulated(self.lessons[-1].model or self._model, self._settings.slider.side)
        lesson = conversions.lesson_of(message, self._settings)
        self._controller.use(self._controller.prepare_model(table, message.lesson_id, lesson))

    def finish(self) -> None:
        """Learns from the last lap."""
        lap = self._collector.finish()
        if lap is not None:
            self._learn(lap)

    def _begin(self) -> None:
        if not self._begun:
            self._learner.begin(reference_of(self._controller.plan, self._settings))
        self._begun = True

    def _learn(self, lap: MeasuredLap) -> None:
        self._begin()
        self.driven.append(self._learner.known)
        self._learner.learn(lap)
        self._announce(1, 0)

    def _announce(self, laps: int, pieces: int) -> None:
        """What is known, after further laps or pieces."""
        self._taught = self._taught[0] + laps, self._taught[1] + pieces
        known, base = self._learner.known, self._model.info.model_id
        self._next = lesson_message(known, self._taught, base, Time())
        self.lessons.append(known)
        self.messages.append(self._next)


def reference_of(plan: Plan, settings: MpcSettings) -> TimedReference:
    """What a plan asks of the object."""
    time, state, _ = plan.until_end()
    return TimedReference(
        Path(settings.track).stem,
        settings.speed,
        settings.laps,
        time,
        np.ascontiguousarray(state[:, :2]),
        float(state[0, 2]),
    )
