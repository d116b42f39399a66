"""The simulator against measured pushes and runs, side by side with the ellipsoid."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray
from push_core.accuracy import Accuracy, accuracy
from push_core.actuator import ActuatorSettings
from push_core.frames import Array
from push_core.long_pushes import LongPushes
from push_core.push_set import PushSet
from push_core.slider import Slider
from tqdm import tqdm

from push_sim.actuator_fit import fitted_actuator
from push_sim.ellipsoid import ELLIPSOID, one_step, rolled_out
from push_sim.measured_data import MeasuredData
from push_sim.replay_long import replay_long, set_out
from push_sim.replay_run import replay_run
from push_sim.replay_short import replay_short
from push_sim.robot_run import RobotRun
from push_sim.run_windows import Windows, windows
from push_sim.settings import SimSettings
from push_sim.tip_replay import commanded_tip
from push_sim.workers import Map

Bar: TypeAlias = 'tqdm[Any]'

_CHUNK = 60
_PATH_STEPS = 500


@dataclass(frozen=True)
class ShortComparison:
    """Short pushes: what was measured and what was predicted, (n, 3) [m, m, rad] each."""

    pushes: PushSet
    simulated: Array
    ellipsoid: Array

    @property
    def accuracy(self) -> Accuracy:
        """Of the simulator."""
        return accuracy(self.simulated, self.pushes)

    @property
    def ellipsoid_accuracy(self) -> Accuracy:
        """Of the ellipsoid."""
        return accuracy(self.ellipsoid, self.pushes)


@dataclass(frozen=True)
class LongComparison:
    """Long pushes of one file: predicted end poses (n, 3) [m, m, rad].

    Attributes:
        file: name of the file.
        pushes: as measured.
        simulated: by the simulator.
        ellipsoid: by the ellipsoid rolled out.
    """

    file: str
    pushes: LongPushes
    simulated: Array
    ellipsoid: Array


@dataclass(frozen=True)
class RunComparison:
    """One robot run.

    Attributes:
        run: as measured.
        actuator: the model of the profile.
        identified: the same with the dead time and lag that suit this run best.
        tip: (n, 2) commanded tip through the model of the profile [m].
        windows: of half a second.
        simulated: (m, 3) end poses of the windows by the simulator [m, m, rad].
        ellipsoid: (m, 3) the same by the ellipsoid.
    """

    run: RobotRun
    actuator: ActuatorSettings
    identified: ActuatorSettings
    tip: Array
    windows: Windows
    simulated: Array
    ellipsoid: Array


@dataclass(frozen=True)
class Validation:
    """Everything that was compared; a part is empty where there were no files."""

    short: ShortComparison | None
    long: tuple[LongComparison, ...]
    runs: tuple[RunComparison, ...]
    missing: tuple[str, ...]


def validation(
    data: MeasuredData, settings: SimSettings, slider: Slider, run_in: Map
) -> Validation:
    """Replays everything; shows a bar.

    Args:
        data: what was measured.
        settings: of the plant; its world and actuator count.
        slider: what was pushed.
        run_in: the processes.
    """
    short = len(data.short) if data.short else 0
    total = short + sum(map(len, data.long.values())) + len(data.runs)
    bar: Bar
    with tqdm(total=total, desc='replaying', unit=' pushes', disable=None) as bar:
        return Validation(
            _short(data.short, settings, slider, run_in, bar) if data.short else None,
            tuple(
                _long(file, pushes, settings, slider, run_in, bar)
                for file, pushes in data.long.items()
            ),
            tuple(_runs(data.runs, settings, slider, run_in, bar)),
            data.missing,
        )


def _chunks(count: int) -> Iterator[NDArray[np.intp]]:
    rows = np.arange(count)
    return (rows[first : first + _CHUNK] for first in range(0, count, _CHUNK))


def _short(
    pushes: PushSet, settings: SimSettings, slider: Slider, run_in: Map, bar: Bar
) -> ShortComparison:
    tasks = (
        (settings.world, slider, pushes.inputs[rows], pushes.distance)
        for rows in _chunks(len(pushes))
    )
    simulated = _gathered(run_in(replay_short, tasks), bar)
    return ShortComparison(pushes, simulated, one_step(ELLIPSOID, pushes.inputs, pushes.distance))


def _long(
    file: str,
    pushes: LongPushes,
    settings: SimSettings,
    slider: Slider,
    run_in: Map,
    bar: Bar,
) -> LongComparison:
    columns = (pushes.start, pushes.tip_start, pushes.tip_end)
    tasks = (
        (settings.world, slider, *(column[rows] for column in columns))
        for rows in _chunks(len(pushes))
    )
    simulated = _gathered(run_in(replay_long, tasks), bar)
    begin = set_out(pushes.tip_start, pushes.tip_end)
    path = np.linspace(begin, pushes.tip_end, _PATH_STEPS + 1, axis=1)
    return LongComparison(file, pushes, simulated, rolled_out(ELLIPSOID, pushes.start, path))


def _runs(
    runs: tuple[RobotRun, ...],
    settings: SimSettings,
    slider: Slider,
    run_in: Map,
    bar: Bar,
) -> Iterator[RunComparison]:
    tasks = ((run, settings, slider) for run in runs)
    for comparison in run_in(compared_run, tasks):
        bar.update()
        yield comparison


def compared_run(run: RobotRun, settings: SimSettings, slider: Slider) -> RunComparison:
    """One robot run against actuator and world of a plant."""
    cut = windows(run)
    return RunComparison(
        run,
        settings.actuator,
        fitted_actuator([run], settings.actuator).settings,
        commanded_tip(run, settings.actuator),
        cut,
        replay_run(settings.world, slider, cut),
        rolled_out(ELLIPSOID, cut.start, cut.tip),
    )


def _gathered(chunks: Iterator[Array], bar: Bar) -> Array:
    parts = []
    for part in chunks:
        bar.update(len(part))
        parts.append(part)
    return np.concatenate(parts)
