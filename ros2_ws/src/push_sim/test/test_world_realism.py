"""What the sources of realism of the world promise, one by one."""

import math

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.physics.limit_surface import GRAVITY, uniform_pressure_radius
from push_core.physics.slider import Slider
from push_sim.settings.world_settings import WorldSettings
from push_sim.worlds.bullet.bullet_world import BulletWorld
from push_sim.worlds.bullet.silent_pybullet import pybullet
from push_sim.worlds.common.support import feet, friction_moment_radius, loads, pressure_radius
from push_sim.worlds.common.table_friction import TableFriction
from push_sim.worlds.engines import make_world

ORIGIN = np.zeros(3)
AWAY = np.array([-1.0, 0.0])


def slid(world, impulse, pose=ORIGIN, seed: int = 0) -> np.ndarray:
    """How far a knocked object slides (2,)."""
    world.reset(pose, AWAY, seed)
    world.push_object(np.array(impulse))
    world.advance((0.0, 0.0), 300)
    return world.object_pose[:2] - pose[:2]


@pytest.mark.parametrize(('variation', 'length'), [(0.1, 0.05), (0.2, 0.02)])
def test_the_friction_of_the_table_has_the_stated_spread_and_length(variation, length) -> None:
    settings = WorldSettings(friction_variation=variation, friction_length=length)
    line = np.arange(0.0, 30.0 * length, length)
    grids = []
    for seed in range(10):
        table = TableFriction(settings, seed)
        grids.append([[table.relative((x, y)) for x in line] for y in line])
    field = np.array(grids) - 1.0
    assert np.mean(field) == pytest.approx(0.0, abs=0.05 * variation)
    assert np.std(field) == pytest.approx(variation, rel=0.03)
    neighbours = np.mean(field[:, :, 1:] * field[:, :, :-1]) / np.var(field)
    assert neighbours == pytest.approx(math.exp(-0.5), abs=0.05)


def test_the_same_seed_gives_the_same_table_and_another_one_another() -> None:
    settings, place = WorldSettings(friction_variation=0.1), (0.3, -0.2)
    one, same, other = (TableFriction(settings, seed).relative(place) for seed in (1, 1, 2))
    assert one == same != other


def test_an_object_slides_as_far_as_the_friction_on_its_way_lets_it(slider: Slider) -> None:
    settings = WorldSettings(friction_variation=0.2, friction_length=0.1)
    world, speed = BulletWorld(settings, slider), 0.6
    for seed in range(3):
        friction = TableFriction(settings, seed)
        places, travel, energy = feet(settings, slider.side, seed), 0.0, 0.5 * speed**2
        while energy > 0.0:
            under = [friction.coefficient((x + travel, y), (1.0, 0.0)) for x, y in places]
            energy -= np.mean(under) * GRAVITY * 1e-4
            travel += 1e-4
        moved = slid(world, [slider.mass * speed, 0.0], seed=seed)
        assert moved[0] == pytest.approx(travel, rel=0.03)


def test_a_varied_table_turns_an_object_that_an_even_one_does_not(slider: Slider) -> None:
    world = BulletWorld(WorldSettings(friction_variation=0.2), slider)
    turns = []
    for seed in (0, 1, 0):
        world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.0), seed)
        world.advance((0.05, 0.0), 600)
        turns.append(world.object_pose[2])
    assert turns[0] == turns[2] != turns[1]
    assert min(np.abs(turns)) > 1e-3


@pytest.mark.parametrize('ratio', [2.0, 0.5])
@pytest.mark.parametrize('theta', [0.0, 0.5])
def test_anisotropic_friction_stops_an_object_in_the_stated_ratio(slider, ratio, theta) -> None:
    world = BulletWorld(WorldSettings(friction_anisotropy=ratio), slider)
    pose = np.array([0.2, 0.1, theta])
    along_x = slid(world, [0.3, 0.0], pose)
    along_y = slid(world, [0.0, 0.3], pose)
    assert along_y[1] / along_x[0] == pytest.approx(ratio, rel=0.01)
    mean = (0.3 / slider.mass) ** 2 / (2.0 * 0.35 * GRAVITY)
    assert math.sqrt(along_x[0] * along_y[1]) == pytest.approx(mean, rel=0.02)


def test_an_even_table_of_four_parts_moves_an_object_as_the_plane_does(slider: Slider) -> None:
    ends = []
    for anisotropy in (1.0, 1.0 + 1e-9):
        world = BulletWorld(WorldSettings(friction_anisotropy=anisotropy), slider)
        world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.015))
        world.advance((0.05, 0.01), 600)
        ends.append(world.object_pose)
    np.testing.assert_allclose(ends[0], ends[1], atol=1e-4)


def test_each_pressure_has_its_friction_moment(slider: Slider) -> None:
    middles = ((np.arange(400) + 0.5) / 400.0 - 0.5) * slider.side
    x, y = np.meshgrid(middles, middles)
    inner = np.maximum(np.abs(x), np.abs(y)) < slider.side / 4.0
    expected = {
        'uniform': np.hypot(x, y).mean(),
        'centred': np.hypot(x, y)[inner].mean(),
        'rim': np.hypot(middles, slider.side / 2.0).mean(),
    }
    for pressure, radius in expected.items():
        places = feet(WorldSettings(pressure=pressure), slider.side, 0)
        assert friction_moment_radius(places) == pytest.approx(radius, rel=1e-4)
    assert pressure_radius('uniform', 0.09) == uniform_pressure_radius(0.09)


def test_random_feet_carry_the_weight_in_balance(slider: Slider) -> None:
    radii = []
    for seed in range(200):
        places = feet(WorldSettings(pressure='random'), slider.side, seed)
        parts = loads(places)
        assert parts.sum() == pytest.approx(1.0)
        np.testing.assert_allclose(parts @ np.array(places), 0.0, atol=1e-12)
        assert parts.min() > 0.0
        radii.append(friction_moment_radius(places))
    assert pressure_radius('centred', 0.09) < min(radii) < 0.03
    assert 0.04 < max(radii) < pressure_radius('rim', 0.09)


@pytest.mark.parametrize('pressure', ['calibrated', 'uniform', 'centred', 'rim', 'random'])
def test_a_spinning_object_stops_as_its_friction_moment_says(slider, pressure: str) -> None:
    settings, seed, speed = WorldSettings(pressure=pressure, substep=2e-4), 2, 4.0
    world = BulletWorld(settings, slider)
    world.reset(ORIGIN, AWAY, seed)
    world.advance((0.0, 0.0), 1)
    pybullet.resetBaseVelocity(
        world._scene._object, (0, 0, 0), (0, 0, speed), world._scene._client
    )
    world.advance((0.0, 0.0), 700)
    c = friction_moment_radius(feet(settings, slider.side, seed))
    deceleration = 0.35 * GRAVITY * c / (slider.side**2 / 6.0)
    assert abs(world.object_pose[2]) == pytest.approx(0.5 * speed**2 / deceleration, rel=0.01)


def test_a_mass_error_slows_a_knocked_object_by_its_square(engine, slider: Slider) -> None:
    light, heavy = (
        slid(make_world(WorldSettings(engine=engine, mass_error=error), slider), [0.3, 0.0])
        for error in (0.0, 0.2)
    )
    assert light[0] / heavy[0] == pytest.approx(1.2**2, rel=0.02)


@pytest.mark.parametrize('error', [0.02, -0.02])
def test_a_size_error_moves_the_face_of_the_object(engine, slider: Slider, error) -> None:
    world = make_world(WorldSettings(engine=engine, size_error=error), slider)
    tip = slider.tip_position(ORIGIN, 0.0)
    world.reset(ORIGIN, tip)
    assert world.object_pose[0] == pytest.approx(max(0.0, error * slider.side / 2.0))
    world.advance((0.02, 0.0), 300)
    face = world.object_pose[0] - slider.side * (1.0 + error) / 2.0
    assert face == pytest.approx(world.tip_position[0] + slider.tip_radius, abs=3e-5)


@pytest.mark.parametrize(
    'changes',
    [{'friction_variation': 0.2}, {'friction_anisotropy': 2.0}, {'pressure': 'random'}],
)
def test_a_snapshot_holds_what_was_drawn(slider: Slider, changes: dict[str, float]) -> None:
    settings = WorldSettings(**changes)
    world, other = BulletWorld(settings, slider), BulletWorld(settings, slider)
    tip = slider.tip_position(ORIGIN, 0.01)
    world.reset(ORIGIN, tip, seed=5)
    world.advance((0.05, 0.02), 57)
    snapshot = world.snapshot()
    world.advance((0.05, 0.02), 100)
    end = world.object_pose
    for restored in (world, other):
        restored.reset(ORIGIN, tip, seed=6)
        restored.advance((0.05, 0.0), 33)
        restored.restore(snapshot)
        restored.advance((0.05, 0.02), 100)
        assert np.array_equal(restored.object_pose, end)


def test_random_feet_are_those_of_the_seed_whatever_came_before(engine, slider: Slider) -> None:
    world, ends = make_world(WorldSettings(engine=engine, pressure='random'), slider), []
    for seed in (1, 2, 1):
        world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.02), seed)
        world.advance((0.05, 0.0), 200)
        ends.append(world.object_pose)
    assert np.array_equal(ends[0], ends[2])
    assert not np.array_equal(ends[0], ends[1])


@pytest.mark.parametrize('name', ['friction_variation', 'friction_anisotropy'])
def test_the_quasi_static_world_refuses_a_table_that_is_not_even(name: str) -> None:
    with pytest.raises(InputError, match=f'world.{name} is 0.3, must be . with'):
        WorldSettings(engine='quasi_static', **{name: 0.3})
