"""The simulator against measured pushes and runs, side by side with the ellipsoid."""

from dataclasses import dataclass

from push_core.common import Map
from push_core.data import Accuracy, LongPushes, PushSet, accuracy
from push_core.geometry import Array
from push_core.physics import ActuatorSettings, Slider
from tqdm import tqdm

from push_sim.fitting import fitted_actuator
from push_sim.measured import Bar, MeasuredData, Replay, RobotRun, Windows, commanded_tip, windows
from push_sim.settings import SimSettings
from push_sim.validation.ellipsoid import ELLIPSOID


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
        ellipsoid: by the ellipsoid.
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
    """Makes everything again; shows a bar.

    Args:
        data: what was measured.
        settings: of the plant; its world and actuator count.
        slider: what was pushed.
        run_in: the processes.
    """
    cuts = [windows(run) for run in data.runs]
    pushes = [data.short or (), *data.long.values(), *(cut.start for cut in cuts)]
    bar: Bar
    # each in both worlds
    with tqdm(
        total=2 * sum(map(len, pushes)), desc='replaying', unit=' pushes', disable=None
    ) as bar:
        replay = Replay(slider, run_in, bar)
        return Validation(
            _short(replay, settings, data.short) if data.short else None,
            tuple(_long(replay, settings, *named) for named in data.long.items()),
            tuple(_run(replay, settings, *pair) for pair in zip(data.runs, cuts, strict=True)),
            data.missing,
        )


def _short(replay: Replay, settings: SimSettings, pushes: PushSet) -> ShortComparison:
    simulated, ellipsoid = (replay.short(world, pushes) for world in (settings.world, ELLIPSOID))
    return ShortComparison(pushes, simulated, ellipsoid)


def _long(replay: Replay, settings: SimSettings, file: str, pushes: LongPushes) -> LongComparison:
    simulated, ellipsoid = (replay.long(world, pushes) for world in (settings.world, ELLIPSOID))
    return LongComparison(file, pushes, simulated, ellipsoid)


def _run(replay: Replay, settings: SimSettings, run: RobotRun, cut: Windows) -> RunComparison:
    simulated, ellipsoid = (replay.windows(world, cut) for world in (settings.world, ELLIPSOID))
    return RunComparison(
        run,
        settings.actuator,
        fitted_actuator(run, settings.actuator).settings,
        commanded_tip(run, settings.actuator),
        cut,
        simulated,
        ellipsoid,
    )
