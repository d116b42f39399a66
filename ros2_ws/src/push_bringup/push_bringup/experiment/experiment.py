"""The paper's experiments, and one lap of one of them in process.

The error is the paper's: distance between the object's centre and the reference point of the same
instant, over the run.
"""

import hashlib
import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from statistics import fmean
from typing import Any

import numpy as np
from push_core.geometry import Array
from push_core.tracks import is_completed
from push_gp.models import ANALYTICAL, model_named
from push_mpc.loop import FOLLOWING, Tick
from push_mpc.plan import planned
from push_sim.plant import Observation

from push_bringup.in_process import InProcessCell
from push_bringup.setup import CellParameters, Request, code_key, installed_config, resolved

PATH_POINTS = 400
"""Points of a lap that are kept for its picture."""


@dataclass(frozen=True)
class Experiment:
    """What is pushed: track, speed [m/s], perturbation."""

    track: str
    speed: float
    perturbation: str = 'none'


PAPER_MM = {
    Experiment('eight', 0.08): {'analytical': 9.56, 'gp': 8.50},
    Experiment('eight', 0.02): {'analytical': 2.89, 'gp': 6.53},
    Experiment('eight', 0.08, 'normal'): {'analytical': 11.10, 'gp': 8.52},
    Experiment('eight', 0.08, 'tangential'): {'analytical': 12.37, 'gp': 9.28},
    Experiment('square', 0.05): {'analytical': 4.95, 'gp': 6.60},
}
"""The rows of the paper's table with its mean errors on the real robot."""


@dataclass(frozen=True)
class LapJob:
    """One lap to be pushed.

    Attributes:
        experiment: what is pushed.
        controller: gp or analytical.
        model: path of the model file, or 'analytical'.
        profile: of the plant and of the robot that the controller assumes.
        seed: of all that is drawn at random.
        overrides: further parameters, as `cell -p` takes them.
    """

    experiment: Experiment
    controller: str
    model: str
    profile: str
    seed: int
    overrides: Mapping[str, object] = field(default_factory=dict)

    @cached_property
    def key(self) -> str:
        """Hash of everything that decides how the lap goes: code, model file, parameters.

        Raises:
            InputError: an override is unknown or out of range.
        """
        path = Path(self.model)
        model = path.read_bytes() if path.is_file() else self.model.encode()
        # where the model file lies does not matter
        values = replace(self, model=ANALYTICAL)
        parameters = values.parameters().as_yaml()
        parts = (code_key().encode(), model, repr(values).encode(), parameters.encode())
        return hashlib.sha256(
            b''.join(hashlib.sha256(part).digest() for part in parts)
        ).hexdigest()

    def parameters(self) -> CellParameters:
        """Those of every node.

        Raises:
            InputError: an override is unknown or out of range.
        """
        request = Request(
            track=self.experiment.track,
            speed=self.experiment.speed,
            controller=self.controller,
            model=self.model,
            profile=self.profile,
            perturb=self.experiment.perturbation,
            laps=1,
            seed=self.seed,
            mode='inprocess',
            output=Path(),
            namespace='',
            overrides=dict(self.overrides),
        )
        return resolved(request, installed_config('cell.yaml'), Path('unused'), Path('unused'))


@dataclass(frozen=True)
class Lap:
    """How a lap went.

    Attributes:
        completed: it came to its end without a stop, the tip on the face, the object near.
        stop_reason: why it stopped before, empty if it did not.
        mean_mm, max_mm: tracking error of the measured poses; up to the stop, if it stopped.
        truth_mean_mm: mean tracking error of the true poses.
        command_step_mm_s: change of the commanded velocity from tick to tick, rms.
        path_mm: where the object's centre was, at most PATH_POINTS places [x, y].
    """

    completed: bool
    stop_reason: str
    mean_mm: float
    max_mm: float
    truth_mean_mm: float
    command_step_mm_s: float
    path_mm: tuple[tuple[float, float], ...]

    @classmethod
    def from_json(cls, values: Mapping[str, Any]) -> 'Lap':
        """The lap that `asdict` turned into JSON."""
        path = tuple((x, y) for x, y in values['path_mm'])
        return cls(**{**values, 'path_mm': path})


def pushed(job: LapJob) -> Lap:
    """Pushes a lap in process.

    Raises:
        InputError: the model cannot be read, a parameter is wrong, or the track cannot be pushed.
    """
    parameters = job.parameters()
    model = model_named(job.model, parameters.gp.slider)
    cell = InProcessCell(parameters, model, planned(parameters.mpc))
    watched = _Watched(cell)
    try:
        reason = cell.run(watched.on_tick)
    finally:
        cell.close()
    return watched.lap(reason, parameters.mpc.slider.side)


class _Watched:
    """Collects what a lap is judged by."""

    def __init__(self, cell: InProcessCell) -> None:
        self._plan = cell.controller.plan
        self._errors: list[float] = []
        self._truth_errors: list[float] = []
        self._path: list[tuple[float, float]] = []
        self._commands: list[Array] = []
        self._last: Tick | None = None

    def on_tick(self, observation: Observation, tick: Tick, _tick_ms: float) -> None:
        """Takes one tick."""
        if tick.mode not in FOLLOWING or tick.reference_time <= 0.0:
            return
        reference = self._plan.at(tick.reference_time)[0][:2]
        x, y = (observation.object_pose[:2] * 1e3).tolist()
        self._errors.append(_distance_mm(observation.object_pose[:2], reference))
        self._truth_errors.append(_distance_mm(observation.truth.object_pose[:2], reference))
        self._path.append((round(x, 2), round(y, 2)))
        self._commands.append(tick.velocity)
        self._last = tick

    def lap(self, reason: str, side: float) -> Lap:
        """The lap, with why it stopped and the side of the square [m]."""
        if self._last is None or self._last.state is None:
            return Lap(False, reason or 'never tracked', math.inf, math.inf, math.inf, 0.0, ())
        completed = is_completed(
            arrived=not reason,
            distance=1e-3 * self._errors[-1],
            gap=self._last.gap,
            contact_offset=self._last.state[3],
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
        )

    def _command_step(self) -> float:
        steps = np.diff(self._commands, axis=0)
        return 1e3 * float(np.sqrt(np.mean(np.sum(steps**2, axis=1)))) if len(steps) else 0.0


def _distance_mm(point: Array, other: Array) -> float:
    """Distance [mm] of two points (2,) [m]."""
    return float(np.hypot(*(1e3 * point - 1e3 * other)))
