import math

import numpy as np
import pytest
from push_core.frames import rotation, to_body, to_world
from push_core.limit_surface import GRAVITY
from push_core.motion_cone import MotionCone
from push_core.slider import Slider
from push_sim.bullet_world import BulletWorld
from push_sim.settings import WorldSettings

ORIGIN = np.zeros(3)
EXACT = WorldSettings(solver_iterations=2000, solver_residual=1e-26)


@pytest.fixture
def world(slider: Slider) -> BulletWorld:
    return BulletWorld(WorldSettings(), slider)


def pushed(world: BulletWorld, pose, tip, velocity, substeps: int = 500) -> np.ndarray:
    """Where the object is after a push, in its frame at the start."""
    world.reset(pose, tip)
    world.advance(velocity, substeps)
    end = world.object_pose
    return np.array([*to_body(pose, end[:2]), math.remainder(end[2] - pose[2], math.tau)])


def test_a_mirrored_push_gives_the_mirrored_motion(slider: Slider) -> None:
    world = BulletWorld(EXACT, slider)
    left = pushed(world, ORIGIN, slider.tip_position(ORIGIN, 0.01), np.array([0.02, 0.01]))
    right = pushed(world, ORIGIN, slider.tip_position(ORIGIN, -0.01), np.array([0.02, -0.01]))
    np.testing.assert_allclose(left * [1.0, -1.0, -1.0], right, rtol=1e-6)


def test_each_face_answers_a_push_alike(slider: Slider) -> None:
    world = BulletWorld(EXACT, slider)
    tip, velocity = slider.tip_position(ORIGIN, 0.01), np.array([0.02, 0.01])
    first = pushed(world, ORIGIN, tip, velocity)
    for quarter in (1, 2, 3):
        turn = rotation(quarter * math.pi / 2.0)
        motion = pushed(world, ORIGIN, turn @ tip, turn @ velocity)
        np.testing.assert_allclose(turn.T @ motion[:2], first[:2], rtol=1e-6)
        assert motion[2] == pytest.approx(first[2], rel=1e-6)


def test_a_push_does_not_depend_on_where_the_object_is(slider: Slider) -> None:
    world = BulletWorld(EXACT, slider)
    velocity, elsewhere = np.array([0.02, 0.01]), np.array([0.4, -0.3, 2.0])
    here = pushed(world, ORIGIN, slider.tip_position(ORIGIN, 0.01), velocity)
    tip = slider.tip_position(elsewhere, 0.01)
    there = pushed(world, elsewhere, tip, rotation(elsewhere[2]) @ velocity)
    np.testing.assert_allclose(there, here, rtol=1e-6)


def test_no_point_of_a_resting_object_drifts_a_micrometre_in_10_s(world, slider) -> None:
    pose = np.array([0.1, -0.2, 0.3])
    world.reset(pose, slider.tip_position(pose, 0.01, gap=0.001))
    world.advance(np.zeros(2), 10_000)
    corner = np.array([slider.side, slider.side]) / 2.0
    drift = to_world(world.object_pose, corner) - to_world(pose, corner)
    assert np.hypot(*drift) < 1e-6


@pytest.mark.parametrize('speed', [0.02, 0.5])
def test_the_tip_neither_sinks_in_nor_tunnels(world, slider, speed: float) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.0, gap=0.02))
    deepest = 0.0
    for _ in range(round(0.1 / speed / 0.001)):
        world.advance(np.array([speed, 0.0]), 1)
        deepest = max(deepest, world.penetration)
    assert slider.gap(world.object_pose, world.tip_position) > -1e-4
    # a blow at half a metre a second may dent the springs for a moment
    assert deepest < 1e-4 * max(1.0, speed / 0.1)


def test_a_sliding_object_stops_where_friction_says(slider: Slider) -> None:
    world = BulletWorld(WorldSettings(substep=1e-4), slider)
    speed, friction = 0.3, WorldSettings().friction_ground
    for heading in np.radians([0.0, 20.0, 45.0]):
        world.reset(ORIGIN, np.array([-1.0, 0.0]))
        world.push_object(slider.mass * speed * np.array([math.cos(heading), math.sin(heading)]))
        world.advance(np.zeros(2), 2000)
        travel = speed**2 / (2.0 * friction * GRAVITY)
        assert np.hypot(*world.object_pose[:2]) == pytest.approx(travel, rel=0.01)


def test_a_centred_push_along_the_normal_moves_the_object_as_far_as_the_tip(world, slider):
    tip, velocity = slider.tip_position(ORIGIN, 0.0), np.array([0.02, 0.0])
    missed = pushed(world, ORIGIN, tip, velocity) - [0.01, 0.0, 0.0]
    assert np.all(np.abs(missed) < [5e-5, 1e-7, 1e-5])


def test_short_pushes_follow_the_motion_cone(world, slider: Slider) -> None:
    settings = WorldSettings()
    same = Slider(friction_pusher=settings.friction_pusher, support_radius=settings.support_radius)
    for p_y, beta in [(0.0, 1.2), (0.02, 1.6), (-0.03, 1.0), (0.01, 2.4)]:
        velocity = 0.02 * np.array([math.sin(beta), math.cos(beta)])
        world.reset(ORIGIN, slider.tip_position(ORIGIN, p_y))
        world.advance(velocity, 20)
        before = world.object_pose
        world.advance(velocity, 50)
        after = world.object_pose
        mean, _ = MotionCone(same).evaluate(np.array([p_y]), np.array([beta]))
        motion = np.array([*to_body(before, after[:2]), after[2] - before[2]])
        # four feet are no ellipsoid: the two agree to a fifth of the push
        assert np.all(np.abs(motion / 0.001 - mean[0]) < [0.2, 0.2, 5.0])


def test_halving_the_substep_hardly_changes_a_50_mm_push(slider: Slider) -> None:
    tip, velocity = slider.tip_position(ORIGIN, 0.015), np.array([0.05, 0.01])
    coarse = pushed(BulletWorld(WorldSettings(), slider), ORIGIN, tip, velocity, 1000)
    half = BulletWorld(WorldSettings(substep=0.0005), slider)
    fine = pushed(half, ORIGIN, tip, velocity, 2000)
    np.testing.assert_allclose(coarse[:2], fine[:2], atol=1e-4)
    assert coarse[2] == pytest.approx(fine[2], abs=math.radians(0.1))


def test_a_contact_is_felt_only_while_the_tip_presses(world, slider) -> None:
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.0, gap=0.001))
    world.advance(np.array([0.02, 0.0]), 20)
    assert not world.contact
    world.advance(np.array([0.02, 0.0]), 60)
    assert world.contact
    world.advance(np.array([-0.02, 0.0]), 20)
    assert not world.contact


def test_the_tip_goes_exactly_where_it_is_told(world, slider) -> None:
    tip = to_world(ORIGIN, slider.tip_position(ORIGIN, 0.01))
    world.reset(ORIGIN, tip)
    world.advance(np.array([0.05, -0.01]), 2000)
    np.testing.assert_allclose(world.tip_position - tip, [0.1, -0.02], atol=1e-7)
