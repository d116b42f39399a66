"""The paper's evaluation, run in process: its rows, our errors beside its own.

The error is the paper's: distance between the object's centre and the reference point of the same
instant, mean over the run.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from statistics import fmean, median

import numpy as np
from push_core.frames import Array
from push_gp.model_source import model_named
from push_mpc.controller import Mode, Tick
from push_sim.plant import Observation

from push_bringup.cell_parameters import installed_config, resolved
from push_bringup.in_process import InProcessCell
from push_bringup.request import Request


@dataclass(frozen=True)
class Experiment:
    """One row of the paper's table, with its errors [mm] on the real robot."""

    track: str
    speed: float
    perturbation: str
    paper_mm: dict[str, float]


EXPERIMENTS = (
    Experiment('eight', 0.08, 'none', {'analytical': 9.56, 'gp': 8.50}),
    Experiment('eight', 0.02, 'none', {'analytical': 2.89, 'gp': 6.53}),
    Experiment('eight', 0.08, 'normal', {'analytical': 11.10, 'gp': 8.52}),
    Experiment('eight', 0.08, 'tangential', {'analytical': 12.37, 'gp': 9.28}),
    Experiment('square', 0.05, 'none', {'analytical': 4.95, 'gp': 6.60}),
)


@dataclass(frozen=True)
class Lap:
    """One run of an experiment: whether it came to its end, and its mean error [mm]."""

    completed: bool
    mean_mm: float


@dataclass(frozen=True)
class Row:
    """All runs of an experiment with one controller."""

    experiment: Experiment
    controller: str
    profile: str
    laps: tuple[Lap, ...]

    def as_json(self) -> dict[str, object]:
        """The row as `bench table --json` prints it."""
        errors = [lap.mean_mm for lap in self.laps]
        return {
            'track': self.experiment.track,
            'speed_m_s': self.experiment.speed,
            'perturbation': self.experiment.perturbation,
            'controller': self.controller,
            'profile': self.profile,
            'seeds': len(self.laps),
            'completed': sum(lap.completed for lap in self.laps),
            'median_mm': median(errors),
            'mean_mm': fmean(errors),
            'spread_mm': max(errors) - min(errors),
            'paper_mm': self.experiment.paper_mm[self.controller],
        }


def laps(
    experiment: Experiment, controller: str, model: str, profile: str, seeds: int
) -> Iterator[Lap]:
    """Runs an experiment once for each seed from 0.

    Args:
        experiment: what to run.
        controller: gp or analytical.
        model: path of the model file, or 'analytical'.
        profile: of the plant.
        seeds: how many.
    """
    for seed in range(seeds):
        request = Request(
            track=experiment.track,
            speed=experiment.speed,
            controller=controller,
            model=model,
            profile=profile,
            perturb=experiment.perturbation,
            laps=1,
            seed=seed,
            mode='inprocess',
            output=Path(),
            namespace='',
            overrides={},
        )
        yield _lap(request)


def _lap(request: Request) -> Lap:
    parameters = resolved(request, installed_config('cell.yaml'), Path('unused'), Path('unused'))
    cell = InProcessCell(parameters, model_named(request.model, parameters.gp.slider))
    errors: list[float] = []
    plan = cell.controller.plan

    def on_tick(observation: Observation, tick: Tick, _tick_ms: float) -> None:
        if tick.mode == Mode.TRACKING and tick.reference_time > 0.0:
            wanted = plan.at(tick.reference_time)[0]
            errors.append(_distance_mm(observation.object_pose, wanted))

    try:
        reason = cell.run(on_tick)
    finally:
        cell.close()
    return Lap(not reason and errors[-1] < 50.0, fmean(errors))


def _distance_mm(pose: Array, wanted: Array) -> float:
    return 1e3 * float(np.hypot(pose[0] - wanted[0], pose[1] - wanted[1]))
