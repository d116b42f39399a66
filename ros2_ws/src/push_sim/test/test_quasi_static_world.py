"""The quasi-static world beside closed forms and an independent integrator."""

import math
import subprocess
import sys

import numpy as np
import pytest
from push_core.geometry.frames import to_body, to_world
from push_core.physics.motion_cone import MotionCone
from push_core.physics.slider import Slider
from push_sim.settings.world_settings import WorldSettings
from push_sim.worlds.quasi_static.quasi_static_world import QuasiStaticWorld
from scipy.integrate import solve_ivp

ORIGIN = np.zeros(3)


def make(slider: Slider, **changes: object) -> QuasiStaticWorld:
    return QuasiStaticWorld(WorldSettings(engine='quasi_static', **changes), slider)


def integrated(slider: Slider, settings: WorldSettings, p_y: float, velocity, duration: float):
    """Object pose (3,) after a push on the face, by an adaptive integrator of the whole state."""
    cone = MotionCone(
        Slider(friction_pusher=settings.friction_pusher, support_radius=settings.support_radius)
    )
    tip = slider.tip_position(ORIGIN, p_y)

    def rates(time: float, pose):
        offset = to_body(pose, tip + np.array(velocity) * time)[1]
        v_n, v_t = to_body(np.array([0.0, 0.0, pose[2]]), np.array(velocity))
        mean, _ = cone.evaluate(np.array([offset]), np.array([math.atan2(v_n, v_t)]))
        turn = np.array([0.0, 0.0, -pose[2]])
        return math.hypot(*velocity) * np.array([*to_body(turn, mean[0, :2]), mean[0, 2]])

    answer = solve_ivp(rates, (0.0, duration), ORIGIN, rtol=1e-10, atol=1e-12, max_step=0.01)
    return answer.y[:, -1]


@pytest.mark.parametrize(('p_y', 'v_y'), [(0.0, 0.01), (0.02, 0.0), (-0.01, 0.03), (0.03, -0.02)])
def test_a_50_mm_push_is_that_of_an_adaptive_integrator_to_a_nanometre(slider, p_y, v_y) -> None:
    world = make(slider)
    world.reset(ORIGIN, slider.tip_position(ORIGIN, p_y))
    for _ in range(800):
        world.advance((0.05, v_y), 1)
    expected = integrated(slider, WorldSettings(), p_y, (0.05, v_y), 0.8)
    np.testing.assert_allclose(world.object_pose, expected, atol=2e-9)


def test_a_tip_that_sticks_rolls_along_the_face(slider: Slider) -> None:
    world = make(slider, friction_pusher=2.0)
    world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.02))
    for _ in range(600):
        world.advance((0.05, 0.0), 1)
    pose = world.object_pose
    rolled = slider.contact_offset(pose, world.tip_position) - 0.02
    assert pose[2] < -0.1
    assert rolled == pytest.approx(slider.tip_radius * pose[2], abs=1e-9)


def test_a_corner_that_sticks_keeps_its_place_on_the_tip(slider: Slider) -> None:
    world, corner = make(slider, friction_pusher=2.0), np.array([slider.p_x, slider.side / 2.0])
    aside = slider.tip_radius * np.array([-math.cos(0.5), math.sin(0.5)])
    world.reset(ORIGIN, corner + aside)
    for _ in range(300):
        world.advance((0.05, 0.0), 1)
    pose = world.object_pose
    assert abs(pose[2]) > 0.1
    np.testing.assert_allclose(world.tip_position - to_world(pose, corner), aside, atol=1e-9)


@pytest.mark.parametrize('tip_radius', [0.0, 0.00475])
def test_the_motion_does_not_depend_on_how_time_is_cut(tip_radius: float) -> None:
    slider, ends = Slider(tip_radius=tip_radius), []
    for substep, pieces in ((0.001, 1500), (0.01, 150), (0.01, 1)):
        world = make(slider, substep=substep)
        world.reset(ORIGIN, slider.tip_position(ORIGIN, 0.03, gap=0.001))
        for _ in range(pieces):
            world.advance((0.04, 0.02), round(1.5 / substep / pieces))
        ends.append(world.object_pose)
    np.testing.assert_allclose(ends[1:], [ends[0]] * 2, atol=2e-9)


def test_a_slide_after_a_knock_is_the_closed_form(slider: Slider) -> None:
    world = make(slider)
    world.reset(ORIGIN, np.array([-1.0, 0.0]))
    world.push_object(np.array([0.2, 0.1]))
    speed, deceleration = math.hypot(0.2, 0.1) / slider.mass, 0.35 * 9.81
    world.advance((0.0, 0.0), 50)
    early = speed * 0.05 - 0.5 * deceleration * 0.05**2
    assert np.hypot(*world.object_pose[:2]) == pytest.approx(early, rel=1e-12)
    world.advance((0.0, 0.0), 200)
    assert np.hypot(*world.object_pose[:2]) == pytest.approx(
        speed**2 / (2.0 * deceleration), rel=1e-12
    )


def test_a_square_that_is_put_down_on_the_tip_is_moved_aside(slider: Slider) -> None:
    world = make(slider)
    world.reset(np.array([-0.001, 0.0, 0.0]), slider.tip_position(ORIGIN, 0.01))
    world.advance((0.0, 0.0), 1)
    np.testing.assert_allclose(world.object_pose, ORIGIN, atol=1e-12)


def test_it_overlaps_by_less_than_a_picometre_whatever_the_tip_does(slider: Slider) -> None:
    random, world = np.random.default_rng(0), make(slider)
    for start in random.uniform(-0.08, 0.08, (30, 2)):
        world.reset(np.array([0.0, 0.0, random.uniform(-3.0, 3.0)]), start + np.array([0.0, 0.15]))
        for _ in range(60):
            world.advance(random.normal(0.0, 0.15, 2) - [0.0, 0.1], 10)
            assert world.penetration < 2e-12


def test_the_plant_runs_on_it_where_pybullet_is_not_installed() -> None:
    program = """
import sys
sys.modules['pybullet'] = None
import numpy as np
from push_core.physics import Slider
from push_sim.plant import Plant
from push_sim.settings import SimSettings, WorldSettings

plant = Plant(SimSettings(world=WorldSettings(engine='quasi_static')), Slider())
plant.reset(np.zeros(3), Slider().tip_position(np.zeros(3), 0.0), seed=0)
plant.command(np.array([0.05, 0.0]), plant.time)
assert plant.step_until_seen().object_pose.shape == (3,)
"""
    subprocess.run([sys.executable, '-c', program], check=True)
