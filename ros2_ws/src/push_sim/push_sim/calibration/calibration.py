"""Calibrates the plant: fits its parameters to one part of the measurements, tests on the rest.

Friction of the pusher and support radius are fitted to pushes, dead time and lag of the actuator
to a robot run. All other parameters stay.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from push_core.common import Map, replaced
from push_core.data import LongPushes, RobotRun
from push_core.physics import ActuatorSettings, Slider
from tqdm import tqdm

from push_sim.fitting import (
    FITTED,
    ActuatorFit,
    PushesToFit,
    WorldFit,
    fit_actuator,
    fit_world,
)
from push_sim.measured import MeasuredData, ProgressBar, Replay, split_measurements
from push_sim.settings import SimSettings
from push_sim.validation import Validation, compare_with_measurements

_WORLD_UNITS = ('', 'm')


@dataclass(frozen=True)
class FittedParameter:
    """One fitted parameter of the simulator.

    Attributes:
        name: dotted name.
        unit: SI unit, '' if it has none.
        value: fitted value, rounded to the digits that its deviation leaves significant.
        deviation: standard deviation, from a bootstrap over the measurements.
        before: initial guess.
    """

    name: str
    unit: str
    value: float
    deviation: float
    before: float


@dataclass(frozen=True)
class PlantCalibration:
    """Fitted parameters and their accuracy.

    Attributes:
        parameters: fitted parameters.
        settings: the plant with these parameters.
        world: fit of the world; None if there are no pushes.
        fitted: comparison with the part that was fitted.
        kept: comparison with the rest.
    """

    parameters: tuple[FittedParameter, ...]
    settings: SimSettings
    world: WorldFit | None
    fitted: Validation
    kept: Validation


def calibrate_plant(
    data: MeasuredData, start: SimSettings, slider: Slider, run_in: Map, seed: int
) -> PlantCalibration:
    """Fits the parameters, then compares the plant with both parts of the measurements.

    Args:
        data: measurements.
        start: initial guess.
        slider: nominal slider.
        run_in: maps a function over tasks, in processes.
        seed: seed of the split and of the bootstrap.
    """
    to_fit, to_test = split_measurements(data, seed)
    world = _world_fit(to_fit, start, slider, run_in, seed)
    parameters = (
        *(_world_parameters(world, start) if world else ()),
        *(_actuator_parameters(to_fit.runs[0], start, seed) if to_fit.runs else ()),
    )
    settings = replaced(start, {each.name: each.value for each in parameters})
    return PlantCalibration(
        parameters,
        settings,
        world,
        compare_with_measurements(to_fit, settings, slider, run_in),
        compare_with_measurements(to_test, settings, slider, run_in),
    )


def _world_fit(
    data: MeasuredData, start: SimSettings, slider: Slider, run_in: Map, seed: int
) -> WorldFit | None:
    pushes = PushesToFit(data.short, _on_face(tuple(data.long.values())))
    if not (pushes.short or pushes.long):
        return None
    bar: ProgressBar
    with tqdm(desc='fitting the world', unit=' pushes', disable=None) as bar:
        return fit_world(Replay(slider, run_in, bar), pushes, start.world, seed)


def _on_face(files: Sequence[LongPushes]) -> LongPushes | None:
    """The pushes of all files that stay on the face, in one set."""
    chosen = [pushes.take(np.flatnonzero(pushes.on_face)) for pushes in files]
    if not sum(map(len, chosen)):
        return None
    columns = ('start', 'end', 'tip_start', 'tip_end')
    joined = (np.concatenate([getattr(each, name) for each in chosen]) for name in columns)
    return LongPushes(chosen[0].slider, *joined)


def _world_parameters(fit: WorldFit, start: SimSettings) -> Sequence[FittedParameter]:
    return [
        _parameter(
            f'world.{name}',
            unit,
            getattr(fit.settings, name),
            deviation,
            getattr(start.world, name),
        )
        for name, unit, deviation in zip(FITTED, _WORLD_UNITS, fit.deviation.tolist(), strict=True)
    ]


def _actuator_parameters(
    run: RobotRun, start: SimSettings, seed: int
) -> Sequence[FittedParameter]:
    return actuator_parameters(fit_actuator(run, start.actuator), start.actuator, seed)


def actuator_parameters(
    fit: ActuatorFit, before: ActuatorSettings, seed: int
) -> Sequence[FittedParameter]:
    """Dead time and lag with their deviations; `seed` is that of the bootstrap."""
    dead_time, lag = fit.deviation(seed).tolist()
    return (
        _parameter('actuator.dead_time', 's', fit.settings.dead_time, dead_time, before.dead_time),
        _parameter('actuator.lag', 's', fit.settings.lag, lag, before.lag),
    )


def _parameter(
    name: str, unit: str, value: float, deviation: float, before: float
) -> FittedParameter:
    return FittedParameter(name, unit, rounded(value, deviation), deviation, before)


def rounded(value: float, deviation: float) -> float:
    """Rounds to the first significant decimal place of the deviation, at most the sixth."""
    return round(value, min(6, -math.floor(math.log10(max(deviation, 1e-9)))))
