"""Compares the simulator, and a fitted ellipsoid, with measured pushes and robot runs."""

from dataclasses import dataclass

from push_core.common import Map
from push_core.data import LongPushes, PushSet, RobotRun
from push_core.geometry import Array
from push_core.physics import ActuatorSettings, Slider
from tqdm import tqdm

from push_sim.fitting import fit_actuator
from push_sim.measured import (
    MeasuredData,
    ProgressBar,
    Replay,
    Windows,
    cut_windows,
    modelled_tip,
)
from push_sim.settings import SimSettings, WorldSettings

ELLIPSOID = WorldSettings(engine='quasi_static', friction_pusher=0.229, support_radius=0.0348)
"""The integrated motion cone with the two parameters that fit the measured 4 mm pushes best."""


@dataclass(frozen=True)
class ShortComparison:
    """Short pushes.

    Attributes:
        pushes: measured pushes.
        simulated: (n, 3) displacements of the simulator [m, m, rad].
        ellipsoid: (n, 3) displacements of the ellipsoid [m, m, rad].
    """

    pushes: PushSet
    simulated: Array
    ellipsoid: Array


@dataclass(frozen=True)
class LongComparison:
    """Long pushes of one file.

    Attributes:
        file: file name.
        pushes: measured pushes.
        simulated: (n, 3) end poses of the simulator [m, m, rad].
        ellipsoid: (n, 3) end poses of the ellipsoid [m, m, rad].
    """

    file: str
    pushes: LongPushes
    simulated: Array
    ellipsoid: Array


@dataclass(frozen=True)
class RunComparison:
    """One robot run.

    Attributes:
        run: measured run of n rows.
        actuator: actuator of the profile.
        identified: the same with the dead time and lag fitted to this run.
        tip: (n, 2) commanded tip through the actuator of the profile [m].
        windows: m windows of half a second.
        simulated: (m, 3) end poses of the windows by the simulator [m, m, rad].
        ellipsoid: (m, 3) end poses by the ellipsoid [m, m, rad].
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
    """All comparisons; a part is None or empty if there are no such files.

    Attributes:
        short: short pushes of all files together.
        long: long pushes, one for each file.
        runs: robot runs.
        missing: kinds of measurements without a file.
    """

    short: ShortComparison | None
    long: tuple[LongComparison, ...]
    runs: tuple[RunComparison, ...]
    missing: tuple[str, ...]


def compare_with_measurements(
    data: MeasuredData, settings: SimSettings, slider: Slider, run_in: Map
) -> Validation:
    """Simulates all measurements with both models; shows a progress bar.

    Args:
        data: measurements.
        settings: plant; only its world and actuator are used.
        slider: nominal slider.
        run_in: maps a function over tasks, in processes.
    """
    cuts = [cut_windows(run) for run in data.runs]
    replayed = [data.short or (), *data.long.values(), *(cut.start for cut in cuts)]
    bar: ProgressBar
    # once with the simulator, once with the ellipsoid
    with tqdm(
        total=2 * sum(map(len, replayed)), desc='replaying', unit=' pushes', disable=None
    ) as bar:
        replay, worlds = Replay(slider, run_in, bar), (settings.world, ELLIPSOID)
        short = [replay.short(world, data.short) for world in worlds if data.short]
        return Validation(
            ShortComparison(data.short, *short) if data.short else None,
            tuple(
                LongComparison(file, pushes, *(replay.long(world, pushes) for world in worlds))
                for file, pushes in data.long.items()
            ),
            tuple(_run(replay, settings, *pair) for pair in zip(data.runs, cuts, strict=True)),
            data.missing,
        )


def _run(replay: Replay, settings: SimSettings, run: RobotRun, cut: Windows) -> RunComparison:
    return RunComparison(
        run,
        settings.actuator,
        fit_actuator(run, settings.actuator).settings,
        modelled_tip(run, settings.actuator),
        cut,
        *(replay.windows(world, cut) for world in (settings.world, ELLIPSOID)),
    )
