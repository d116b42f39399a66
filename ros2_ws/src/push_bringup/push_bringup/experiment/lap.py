"""One lap of an experiment in process, and its outcome.

The tracking error is that of the paper: distance between the object's centre and the reference
point of the same instant.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from statistics import fmean
from typing import Any

import numpy as np
from push_core.geometry import Array
from push_core.tracks import is_completed
from push_gp.learn import Identified
from push_gp.models import model_named
from push_mpc.loop import FOLLOWING, Tick
from push_mpc.plan import planned
from push_sim.plant import Observation, TrueState

from push_bringup.experiment.experiment import LapJob
from push_bringup.in_process import InProcessCell

PATH_POINTS = 400
"""Points of a lap that are kept for drawing it."""


@dataclass(frozen=True)
class LapErrors:
    """One round of several.

    Attributes:
        mean_mm, max_mm: tracking error of the measured poses.
        truth_mean_mm: mean tracking error of the true poses.
        friction, support_radius_mm: identified value and its standard deviation, with which the
            round ended; None if nothing had been learned.
    """

    mean_mm: float
    max_mm: float
    truth_mean_mm: float
    friction: tuple[float, float] | None = None
    support_radius_mm: tuple[float, float] | None = None


@dataclass(frozen=True)
class Lap:
    """The outcome of a run of one lap or more.

    Attributes:
        completed: see `push_core.tracks.is_completed`; by the true poses.
        stop_reason: reason of an early stop, else empty.
        mean_mm, max_mm: tracking error of the measured poses; up to the stop, if it stopped.
        truth_mean_mm: mean tracking error of the true poses.
        command_step_mm_s: change of the commanded velocity from tick to tick, rms.
        path_mm: positions [x, y] of the object's centre, at most PATH_POINTS.
        error_mm: tracking errors at these positions.
        per_lap: each round by itself, as far as the run came.
    """

    completed: bool
    stop_reason: str
    mean_mm: float
    max_mm: float
    truth_mean_mm: float
    command_step_mm_s: float
    path_mm: tuple[tuple[float, float], ...]
    error_mm: tuple[float, ...]
    per_lap: tuple[LapErrors, ...]

    @classmethod
    def from_json(cls, values: Mapping[str, Any]) -> 'Lap':
        """The lap from the JSON of its `asdict`."""
        path = tuple((x, y) for x, y in values['path_mm'])
        rounds = tuple(LapErrors(**{**one, **_pairs(one)}) for one in values['per_lap'])
        errors = tuple(values['error_mm'])
        return cls(**{**values, 'path_mm': path, 'error_mm': errors, 'per_lap': rounds})


def pushed(job: LapJob) -> Lap:
    """Pushes a lap in process.

    Raises:
        InputError: the model cannot be read, a parameter is wrong, or the track cannot be pushed.
    """
    parameters = job.parameters()
    model = model_named(job.model, parameters.gp.slider)
    cell = InProcessCell(parameters, model, planned(parameters.mpc), job.learn)
    recorder = _LapRecorder(cell, job.laps)
    try:
        reason = cell.run(recorder.on_tick)
    finally:
        cell.close()
    return recorder.lap(reason, parameters.mpc.slider.side)


class _LapRecorder:
    """Collects the outcome of a lap."""

    def __init__(self, cell: InProcessCell, laps: int) -> None:
        self._plan = cell.controller.plan
        self._lap_time = self._plan.duration / laps
        self._school = cell.school
        self._times: list[float] = []
        self._errors: list[float] = []
        self._truth_errors: list[float] = []
        self._path: list[tuple[float, float]] = []
        self._commands: list[Array] = []
        self._slider = cell.plant.true_slider
        self._last: TrueState | None = None

    def on_tick(self, observation: Observation | None, tick: Tick, _tick_ms: float) -> None:
        """Takes one tick; errors are those at the exposures."""
        if observation is None or tick.mode not in FOLLOWING or tick.reference_time <= 0.0:
            return
        reference = self._plan.at(tick.reference_time)[0][:2]
        self._times.append(tick.reference_time)
        x, y = (observation.object_pose[:2] * 1e3).tolist()
        self._errors.append(_distance_mm(observation.object_pose[:2], reference))
        self._truth_errors.append(_distance_mm(observation.truth.object_pose[:2], reference))
        self._path.append((round(x, 2), round(y, 2)))
        self._commands.append(tick.velocity)
        self._last = observation.truth

    def lap(self, reason: str, side: float) -> Lap:
        """The lap, with why it stopped and the side of the square [m]."""
        if self._last is None:
            return Lap(
                False, reason or 'never tracked', math.inf, math.inf, math.inf, 0.0, (), (), ()
            )
        end = self._last.object_pose, self._last.tip_position
        completed = is_completed(
            arrived=not reason,
            distance=1e-3 * self._truth_errors[-1],
            gap=self._slider.gap(*end),
            contact_offset=self._slider.contact_offset(*end),
            side=side,
        )
        step = -(-len(self._path) // PATH_POINTS)
        return Lap(
            completed=completed,
            stop_reason=reason,
            mean_mm=fmean(self._errors),
            max_mm=max(self._errors),
            truth_mean_mm=fmean(self._truth_errors),
            command_step_mm_s=self._command_step(),
            path_mm=tuple(self._path[::step]),
            error_mm=tuple(round(each, 3) for each in self._errors[::step]),
            per_lap=self._per_lap(),
        )

    def _per_lap(self) -> tuple[LapErrors, ...]:
        ends = np.arange(self._lap_time, self._times[-1], self._lap_time)
        rows = np.searchsorted(self._times, ends)
        parts = [np.split(np.array(each), rows) for each in (self._errors, self._truth_errors)]
        lessons = self._school.driven if self._school else []
        known = [each.identified if each.model else None for each in lessons]
        known += [None] * (len(rows) + 1 - len(known))
        return tuple(
            LapErrors(
                float(errors.mean()),
                float(errors.max()),
                float(truth.mean()),
                *(_identified(cone) if cone else (None, None)),
            )
            for errors, truth, cone in zip(*parts, known, strict=False)
        )

    def _command_step(self) -> float:
        steps = np.diff(self._commands, axis=0)
        return 1e3 * float(np.sqrt(np.mean(np.sum(steps**2, axis=1)))) if len(steps) else 0.0


def _distance_mm(point: Array, other: Array) -> float:
    """Distance [mm] of two points (2,) [m]."""
    return float(np.hypot(*(1e3 * point - 1e3 * other)))


def _identified(cone: Identified) -> tuple[tuple[float, float], tuple[float, float]]:
    radius, uncertainty = cone.support_radius
    return cone.friction, (1e3 * radius, 1e3 * uncertainty)


def _pairs(values: Mapping[str, Any]) -> dict[str, tuple[float, ...]]:
    """The lists of JSON as the tuples that they were."""
    return {name: tuple(value) for name, value in values.items() if isinstance(value, list)}
