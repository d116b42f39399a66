"""The parameters of the plant that the measurements tell, how sure they are, and how well they do.

Fitted are the friction of the pusher and the support radius to pushes, the dead time and the lag
of the actuator to a robot run; everything else stays. One part of the measurements is fitted, the
rest judges.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from push_core.common import Map, replaced
from push_core.data import LongPushes
from push_core.physics import Slider
from tqdm import tqdm

from push_sim.fitting import FITTED, Pushes, WorldFit, fitted_actuator, fitted_world
from push_sim.measured import Bar, MeasuredData, Replay, RobotRun, split
from push_sim.settings import SimSettings
from push_sim.validation import Validation, validation


@dataclass(frozen=True)
class Fitted:
    """One parameter.

    Attributes:
        name: of the simulator's parameter, dotted.
        unit: '' where it has none.
        value: that was found, rounded to what its deviation leaves certain.
        deviation: standard deviation by a bootstrap over the measurements.
        before: value at which the search began.
    """

    name: str
    unit: str
    value: float
    deviation: float
    before: float


@dataclass(frozen=True)
class Calibration:
    """What was found and how well it does.

    Attributes:
        parameters: that were fitted.
        settings: of the plant with them.
        world: the fit of the world; None where there are no pushes.
        fitted: comparison with the part that was fitted.
        kept: comparison with the rest.
    """

    parameters: tuple[Fitted, ...]
    settings: SimSettings
    world: WorldFit | None
    fitted: Validation
    kept: Validation


def calibration(
    data: MeasuredData, start: SimSettings, slider: Slider, run_in: Map, seed: int
) -> Calibration:
    """Fits, then compares with both parts.

    Args:
        data: what was measured.
        start: plant at which the search begins.
        slider: what was pushed.
        run_in: the processes.
        seed: of the split and of the bootstrap.
    """
    to_fit, to_judge = split(data, seed)
    world = _world(to_fit, start, slider, run_in, seed)
    parameters = (
        *(_world_parameters(world, start) if world else ()),
        *(_actuator_parameters(to_fit.runs[0], start, seed) if to_fit.runs else ()),
    )
    settings = _with_parameters(start, parameters)
    return Calibration(
        parameters,
        settings,
        world,
        validation(to_fit, settings, slider, run_in),
        validation(to_judge, settings, slider, run_in),
    )


def _world(
    data: MeasuredData, start: SimSettings, slider: Slider, run_in: Map, seed: int
) -> WorldFit | None:
    pushes = Pushes(data.short, _on_face(tuple(data.long.values())))
    if not (pushes.short or pushes.long):
        return None
    bar: Bar
    with tqdm(desc='fitting the world', unit=' pushes', disable=None) as bar:
        return fitted_world(Replay(slider, run_in, bar), pushes, start.world, seed)


def _on_face(files: Sequence[LongPushes]) -> LongPushes | None:
    """The pushes of all files that stay on the face, in one set."""
    chosen = [pushes.take(np.flatnonzero(pushes.on_face)) for pushes in files]
    if not sum(map(len, chosen)):
        return None
    columns = ('start', 'end', 'tip_start', 'tip_end')
    joined = (np.concatenate([getattr(each, name) for each in chosen]) for name in columns)
    return LongPushes(chosen[0].slider, *joined)


def _world_parameters(fit: WorldFit, start: SimSettings) -> tuple[Fitted, ...]:
    units = ('', 'm')
    return tuple(
        _fitted(f'world.{name}', unit, getattr(fit.settings, name), deviation, before)
        for name, unit, deviation, before in zip(
            FITTED,
            units,
            fit.deviation.tolist(),
            (getattr(start.world, name) for name in FITTED),
            strict=True,
        )
    )


def _actuator_parameters(run: RobotRun, start: SimSettings, seed: int) -> tuple[Fitted, ...]:
    fit, before = fitted_actuator(run, start.actuator), start.actuator
    dead_time, lag = fit.deviation(seed).tolist()
    return (
        _fitted('actuator.dead_time', 's', fit.settings.dead_time, dead_time, before.dead_time),
        _fitted('actuator.lag', 's', fit.settings.lag, lag, before.lag),
    )


def _fitted(name: str, unit: str, value: float, deviation: float, before: float) -> Fitted:
    return Fitted(name, unit, rounded(value, deviation), deviation, before)


def rounded(value: float, deviation: float) -> float:
    """The value to the decimal place of its deviation's first digit, the sixth at the most."""
    return round(value, min(6, -math.floor(math.log10(max(deviation, 1e-9)))))


def _with_parameters(settings: SimSettings, parameters: Sequence[Fitted]) -> SimSettings:
    return replaced(settings, {each.name: each.value for each in parameters})
