"""What every engine promises."""

import math

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_core.geometry.frames import rotation, to_body, to_world
from push_core.physics.limit_surface import GRAVITY
from push_sim.settings.world_settings import WorldSettings
from push_sim.worlds.common.world import World
from push_sim.worlds.engines import make_world

ORIGIN = np.zeros(3)
PUSHES = [(0.01, (0.02, 0.01)), (-0.03, (0.05, 0.02)), (0.0, (0.05, -0.01))]


def pushed(world: World, pose, tip, velocity, substeps: int = 500) -> np.ndarray:
    """Where the object is after a push, in its frame at the start."""
    world.reset(pose, tip)
    world.advance(velocity, substeps)
    return moved(pose, world.object_pose)


def moved(start, end) -> np.ndarray:
    return np.array([*to_body(start, end[:2]), math.remainder(end[2] - start[2], math.tau)])


def weave(world: World, steps: int, seed: int) -> np.ndarray:
    """All that can be seen (steps, 6) of a push that goes here and there."""
    random, rows = np.random.default_rng(seed), []
    for _ in range(steps):
        world.advance((0.06, random.normal(0.0, 0.03)), 1)
        rows.append([*world.object_pose, *world.tip_position, world.contact])
    return np.array(rows)


@pytest.mark.parametrize(('p_y', 'velocity'), PUSHES)
def test_a_mirrored_push_gives_the_mirrored_motion(world, slider, p_y, velocity) -> None:
    left = pushed(world, ORIGIN, slider.tip_position(ORIGIN, p_y), velocity)
    mirrored = (velocity[0], -velocity[1])
    right = pushed(world, ORIGIN, slider.tip_position(ORIGIN, -p_y), mirrored)
    np.testing.assert_allclose(left * [1.0, -1.0, -1.0], right, rtol=1e-6)


@pytest.mark.parametrize(('p_y', 'velocity'), PUSHES)
def test_each_face_answers_a_push_alike(world, slider, p_y, velocity) -> None:
    tip = slider.tip_position(ORIGIN, p_y)
    first = pushed(world, ORIGIN, tip, velocity)
    for quarter in (1, 2, 3):
        turn = rotation(quarter * math.pi / 2.0)
        motion = pushed(world, ORIGIN, turn @ tip, turn @ np.array(velocity))
        np.testing.assert_allclose(turn.T @ motion[:2], first[:2], rtol=1e-6)
        assert motion[2] == pytest.approx(first[2], rel=1e-6)


@pytest.mark.parametrize(('p_y', 'velocity'), PUSHES)
def test_a_push_does_not_depend_on_where_the_object_is(world, slider, p_y, velocity) -> None:
    elsewhere = np.array([0.4, -0.3, 2.0])
    here = pushed(world, ORIGIN, slider.tip_position(ORIGIN, p_y), velocity)
    tip = slider.tip_position(elsewhere, p_y)
    there = pushed(world, elsewhere, tip, rotation(elsewhere[2]) @ np.array(velocity))
    np.testing.assert_allclose(there, here, rtol=1e-6)


def test_no_point_of_a_resting_object_drifts_a_micrometre_in_10_s(world, slider) -> None:
    pose = np.array([0.1, -0.2, 0.3])
    world.reset(pose, slider.tip_position(pose, 0.01, gap=0.001))
    world.advance((0.0, 0.0), 10_000)
    corner = np.array([slider.side, slider.side]) / 2.0
    drift = to_world(world.object_pose, corner) - to_world(pose, corner)
    assert np.hypot(*drift) < 1e-6


def test_a_centred_push_along_the_normal_moves_the_object_as_far_as_the_tip(world, slider):
    missed = pushed(world, ORIGIN, slider.tip_position(ORIGIN, 0.0), (0.02, 0.0)) - [0.01, 0, 0]
    assert np.all(np.abs(missed) < [5e-5, 1e-7, 1e-5])


@pytest.mark.parametrize('p_y', [-0.03, 0.0, 0.04])
@pytest.mark.parametrize('angle', [-40.0, 0.0, 20.0])
def test_halving_the_substep_hardly_changes_a_50_mm_push(engine, slider, p_y, angle) -> None:
    velocity = 0.1 * np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    ends = []
    for substep in (0.001, 0.0005):
        world = make_world(WorldSettings(engine=engine, substep=substep), slider)
        tip = slider.tip_position(ORIGIN, p_y)
        ends.append(pushed(world, ORIGIN, tip, velocity, round(0.5 / substep)))
        world.close()
    difference = np.abs(ends[0] - ends[1])
    assert np.hypot(*difference[:2]) < 1e-4
    assert difference[2] < math.radians(0.1)


def test_a_contact_is_felt_only_while_the_tip_presses(world, slider) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.0, gap=0.001))
    world.advance((0.02, 0.0), 20)
    assert not world.contact
    world.advance((0.02, 0.0), 60)
    assert world.contact
    world.advance((-0.02, 0.0), 20)
    assert not world.contact


def test_a_tip_that_is_pulled_away_leaves_the_object_at_rest(world, slider) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.02))
    world.advance((0.05, 0.0), 200)
    world.advance((-0.05, 0.02), 100)
    left = world.object_pose
    world.advance((-0.05, 0.02), 200)
    np.testing.assert_allclose(world.object_pose, left, atol=1e-7)


def test_the_tip_goes_exactly_where_it_is_told(world, slider) -> None:
    tip = to_world(ORIGIN, slider.tip_position(ORIGIN, 0.01))
    world.reset(ORIGIN, tip)
    world.advance((0.05, -0.01), 2000)
    np.testing.assert_allclose(world.tip_position - tip, [0.1, -0.02], atol=1e-7)


def test_a_push_at_the_end_of_a_face_slips_round_the_corner_and_off(world, slider) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.04))
    world.advance((0.02, 0.04), 2000)
    assert not world.contact
    assert to_body(world.object_pose, world.tip_position)[1] > slider.side / 2.0
    assert world.object_pose[2] < -0.01


@pytest.mark.parametrize('gap', [0.02, 0.0201, 0.0203])
@pytest.mark.parametrize(('speed', 'angle'), [(0.02, 0.0), (0.1, 40.0), (0.5, 0.0), (0.5, 60.0)])
def test_nothing_sinks_in_or_tunnels(world, slider, gap, speed, angle) -> None:
    tip = slider.tip_position(ORIGIN, -0.03, gap)
    world.reset(ORIGIN, tip)
    direction = np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    for _ in range(round(0.06 / speed / 0.001)):
        world.advance(speed * direction, 1)
        assert world.penetration <= 1e-4
    assert slider.gap(world.object_pose, world.tip_position) > -1e-4


def test_an_object_knocked_against_the_tip_does_not_sink_in(world, slider) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.01, gap=0.0123))
    world.push_object(np.array([-0.5, 0.0]))
    for _ in range(200):
        world.advance((0.0, 0.0), 1)
        assert world.penetration <= 1e-4
    assert world.object_pose[0] == pytest.approx(-0.0123, abs=1e-3)


@pytest.mark.parametrize('heading', [0.0, 20.0, 45.0])
def test_a_knocked_object_stops_where_friction_says(engine, slider, heading: float) -> None:
    settings = WorldSettings(engine=engine, substep=1e-4)
    world = make_world(settings, slider)
    world.reset(ORIGIN, np.array([-1.0, 0.0]))
    speed, angle = 0.3, math.radians(heading)
    world.push_object(slider.mass * speed * np.array([math.cos(angle), math.sin(angle)]))
    world.advance((0.0, 0.0), 2000)
    travel = speed**2 / (2.0 * settings.friction_ground * GRAVITY)
    assert np.hypot(*world.object_pose[:2]) == pytest.approx(travel, rel=0.01)


def test_an_object_that_is_knocked_into_the_tip_stops_there(world, slider) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.0, gap=0.002))
    world.push_object(np.array([-0.3, 0.0]))
    world.advance((0.0, 0.0), 300)
    assert world.object_pose[0] == pytest.approx(-0.002, abs=1e-4)


def test_an_object_that_is_put_down_stays_there(world, slider) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.0))
    world.advance((0.05, 0.0), 100)
    pose = np.array([0.2, 0.1, 1.0])
    world.place_object(pose)
    np.testing.assert_allclose(world.object_pose, pose, atol=1e-12)
    world.advance((0.05, 0.0), 100)
    np.testing.assert_allclose(world.object_pose, pose, atol=1e-6)


def test_a_reset_gives_the_same_trajectory_whatever_came_before(world, slider) -> None:
    tip = slider.tip_position(ORIGIN, 0.01)
    world.reset(ORIGIN, tip)
    first = weave(world, 100, seed=0)
    world.push_object(np.array([0.1, 0.2]))
    weave(world, 37, seed=1)
    world.push_object(np.array([0.1, 0.2]))
    world.reset(ORIGIN, tip)
    assert np.array_equal(weave(world, 100, seed=0), first)


@pytest.mark.parametrize('steps', [0, 57, 133])
def test_a_restored_world_goes_on_to_the_last_bit(engine, world, slider, steps: int) -> None:
    tip = slider.tip_position(ORIGIN, 0.01, gap=0.0005)
    world.reset(ORIGIN, tip)
    weave(world, steps, seed=0)
    undisturbed = weave(world, 100, seed=1)
    world.reset(ORIGIN, tip)
    weave(world, steps, seed=0)
    snapshot = world.snapshot()
    assert np.array_equal(weave(world, 100, seed=1), undisturbed)
    world.reset(np.array([0.3, 0.0, 1.0]), np.array([0.0, 0.0]))
    weave(world, 60, seed=2)
    other = make_world(WorldSettings(engine=engine), slider)
    for restored in (world, other):
        restored.restore(snapshot)
        assert np.array_equal(weave(restored, 100, seed=1), undisturbed)


def test_a_snapshot_keeps_the_speed_of_a_sliding_object_and_a_knock_to_come(world) -> None:
    world.reset(ORIGIN, np.array([-1.0, 0.0]))
    world.push_object(np.array([0.3, 0.1]))
    to_come = world.snapshot()
    world.advance((0.0, 0.0), 40)
    sliding = world.snapshot()
    world.advance((0.0, 0.0), 200)
    end = world.object_pose
    world.restore(sliding)
    world.advance((0.0, 0.0), 200)
    assert np.array_equal(world.object_pose, end)
    world.restore(to_come)
    world.advance((0.0, 0.0), 40)
    world.advance((0.0, 0.0), 200)
    assert np.array_equal(world.object_pose, end)


def test_a_snapshot_of_another_engine_is_refused(engine, world, slider) -> None:
    other = 'bullet' if engine == 'quasi_static' else 'quasi_static'
    stranger = make_world(WorldSettings(engine=other), slider)
    with pytest.raises(InputError, match=engine):
        world.restore(stranger.snapshot())
