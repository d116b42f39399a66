import math
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from push_core.common.settings import replaced
from push_core.data.long_push_csv import COLUMNS as LONG_COLUMNS
from push_core.data.push_csv import write_pushes
from push_core.data.push_set import PushSet
from push_core.data.robot_run import COLUMNS as RUN_COLUMNS
from push_core.data.robot_run import RobotRun
from push_core.geometry.frames import Array, rotation
from push_core.physics.slider import Slider
from push_sim.collect.collector import Collector
from push_sim.collect.push_design import PushDesign
from push_sim.collect.push_sampling import uniform
from push_sim.measured.replay import replay_long_pushes, replay_windows
from push_sim.measured.run_windows import INTERVAL
from push_sim.measured.tip_replay import modelled_tip
from push_sim.plant.plant import Plant
from push_sim.settings.plant_settings import SimSettings
from push_sim.settings.profiles import profile
from push_sim.settings.world_settings import WorldSettings
from push_sim.worlds.common.world import World
from push_sim.worlds.engines import ENGINES, make_world

POSE = np.array([0.1, -0.2, 0.3])


@pytest.fixture
def slider() -> Slider:
    return Slider()


@pytest.fixture
def start(slider: Slider) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """An object pose and a tip that touches it."""
    return POSE, slider.tip_position(POSE, 0.01)


@pytest.fixture
def weave():
    """World velocity (2,) of a push that weaves, at a number of periods."""

    def velocity(tick: int, speed: float = 0.08) -> NDArray[np.float64]:
        return rotation(POSE[2]) @ [speed, 0.02 * math.sin(0.1 * tick)]

    return velocity


@pytest.fixture(params=sorted(ENGINES))
def engine(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def world(engine: str, slider: Slider) -> Iterator[World]:
    world = make_world(WorldSettings(engine=engine), slider)
    yield world
    world.close()


@pytest.fixture
def ideal(engine: str, slider: Slider) -> Iterator[Plant]:
    plant = Plant(replaced(profile('ideal'), {'world.engine': engine}), slider)
    yield plant
    plant.close()


@pytest.fixture
def irb120(engine: str, slider: Slider) -> Iterator[Plant]:
    plant = Plant(replaced(profile('irb120'), {'world.engine': engine}), slider)
    yield plant
    plant.close()


MeasureArtificially = Callable[[Path, SimSettings], Path]


@pytest.fixture(scope='session')
def measure_artificially() -> MeasureArtificially:
    """Makes a folder of measurements of a plant that is known."""

    def measure(folder: Path, plant: SimSettings) -> Path:
        (folder / 'robot_runs').mkdir()
        write_pushes(folder / 'square_4mm_pushes.csv', _short_pushes(plant, 48))
        long = _long_pushes(plant.world, 6)
        _write_table(folder / 'square_50mm_pushes_artificial.csv', LONG_COLUMNS, long)
        _write_table(folder / 'robot_runs' / 'weave.csv', RUN_COLUMNS, _run(plant))
        return folder

    return measure


def _write_table(path: Path, names: tuple[str, ...], table: Array) -> None:
    np.savetxt(path, table, delimiter=',', header=','.join(names), comments='')


def _short_pushes(plant: SimSettings, count: int) -> PushSet:
    slider, design = Slider(), PushDesign()
    sampler = uniform(design, slider.side, count)
    with closing(Collector(plant, slider, design, sampler)) as collector:
        rows = np.array([collector.push(3, number) for number in range(count)])
    return PushSet(rows[:, 0], rows[:, 1], rows[:, 2:], design.distance)


def _long_pushes(world: WorldSettings, count: int) -> Array:
    """Rows (n, 10) of pushes on all four sides, straight and aslant."""
    slider, poses, tips = Slider(), [], []
    for number in range(count):
        pose = np.array([0.1 * number, 0.0, 0.7 * number])
        face = pose + np.array([0.0, 0.0, number * math.pi / 2.0])
        tip = slider.tip_position(face, 0.006 * number - 0.015)
        way = 0.05 * np.array([math.cos(0.1 * number), math.sin(0.1 * number)])
        poses.append(pose)
        tips.append([tip, tip + rotation(face[2]) @ way])
    start, tip = np.array(poses), np.array(tips)
    end = replay_long_pushes(world, slider, start, tip[:, 0], tip[:, 1])
    return np.hstack((start, end, tip[:, 0], tip[:, 1]))


def _run(plant: SimSettings) -> Array:
    """Rows (n, 8) of three seconds: a square is pushed along x by a tip that weaves."""
    time = 0.002 * np.arange(1501)
    commanded = np.column_stack((0.04 * time, 0.004 * np.sin(2.5 * time)))
    still = np.tile([0.049750001, 0.0, 0.0], (time.size, 1))
    asked = RobotRun('weave.csv', time, still, commanded, np.zeros_like(commanded))
    sensed = modelled_tip(asked, plant.actuator)
    every = round(INTERVAL / 0.002)
    path = sensed[::every]
    # the object is right at the edges of the windows, which is where it is compared
    poses = [still[0]]
    for first in range(0, len(path) - 1, _WINDOW_POINTS):
        tip = path[first : first + _WINDOW_POINTS + 1]
        poses.append(replay_windows(plant.world, Slider(), poses[-1][None], tip[None])[0])
    marks = np.arange(len(poses)) * _WINDOW_POINTS * INTERVAL
    pose = np.column_stack([np.interp(time, marks, axis) for axis in np.array(poses).T])
    return np.column_stack((time, pose, commanded, sensed))


_WINDOW_POINTS = 50
