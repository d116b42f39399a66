"""The predictor, held to closed forms and to a simulation in steps a hundred times finer."""

import math
from dataclasses import replace

import numpy as np
import pytest
from push_core.geometry.frames import rotation
from push_core.physics.actuator import ACTUATORS
from push_mpc.estimate.predictor import Predictor
from push_mpc.table.surrogate import Grid, Table

ROBOT = ACTUATORS['irb120']
DELAY = ROBOT.dead_time + ROBOT.lag
POSE = np.array([0.1, -0.2, 0.6])
P_Y = 0.008
UNDISTURBED = np.zeros(3)


@pytest.fixture
def predictor(slider) -> Predictor:
    return Predictor(ROBOT, slider)


@pytest.fixture
def constant_table() -> Table:
    """A model whose object goes 0.9 forwards and 0.1 to the left of every metre of push."""
    grid = Grid(np.linspace(-0.045, 0.045, 3), np.linspace(0.1, 3.0, 3))
    return Table(grid, np.tile([0.9, 0.1, 0.0], (9, 1)), np.zeros((9, 3, 2)))


def tip_velocity(time, commands):
    """Velocity (2,) of a robot with dead time and lag, by the closed form of its steps."""
    velocity, before = np.zeros(2), np.zeros(2)
    for sent, command in commands:
        since = time - sent - ROBOT.dead_time
        if since > 0.0:
            velocity = velocity + (command - before) * (1.0 - math.exp(-since / ROBOT.lag))
        before = command
    return velocity


def simulated(slider, table, commands, start, until, step=1e-4):
    """Pose (3,) and tip (2,) by Euler steps of the same models."""
    pose, tip = POSE.copy(), slider.tip_position(POSE, P_Y)
    for index in range(round((until - start) / step)):
        velocity = tip_velocity(start + (index + 0.5) * step, commands)
        v_n, v_t = rotation(-pose[2]) @ velocity
        if v_n > 0.0:
            p_y = slider.contact_offset(pose, tip)
            dx, dy, turn = table.rate(p_y, math.atan2(v_n, v_t))
            travel = step * math.hypot(v_n, v_t)
            pose += travel * np.array([*(rotation(pose[2]) @ [dx, dy]), turn])
        tip = tip + step * velocity
    return pose, tip


def test_an_even_push_moves_the_object_by_its_rate_and_the_disturbance(
    predictor, slider, constant_table
) -> None:
    velocity = rotation(POSE[2]) @ [0.08, 0.01]
    predictor.sent(velocity, 0.0)
    tip = slider.tip_position(POSE, P_Y)
    predictor.predict(constant_table, UNDISTURBED, POSE, tip, 0.0, DELAY)
    beside = np.array([0.02, -0.1, 0.0])
    pose, place = predictor.predict(constant_table, beside, POSE, tip, 2.0, 2.0 + DELAY)
    travel = DELAY * math.hypot(*velocity)
    assert pose[:2] == pytest.approx(POSE[:2] + travel * rotation(POSE[2]) @ [0.92, 0.0])
    assert pose[2] == POSE[2]
    assert place == pytest.approx(tip + DELAY * velocity)


@pytest.mark.parametrize('latency', [0.0, 0.005, 0.0137])
def test_commands_under_way_act_when_they_will(predictor, slider, table, latency) -> None:
    """Six commands, each sent some time after its exposure; all still under way at the last."""
    generator = np.random.default_rng(1)
    body = generator.uniform([0.05, -0.03], [0.1, 0.03], (6, 2))
    commands = [(0.01 * i + latency, rotation(POSE[2]) @ v) for i, v in enumerate(body)]
    tip = slider.tip_position(POSE, P_Y)
    for sent, velocity in commands:
        predictor.predict(table, UNDISTURBED, POSE, tip, sent - latency, sent + DELAY)
        predictor.sent(velocity, sent)
    start, until = 0.06, 0.06 + latency + DELAY
    pose, place = predictor.predict(table, UNDISTURBED, POSE, tip, start, until)
    expected_pose, expected_place = simulated(slider, table, commands, start, until)
    assert place == pytest.approx(expected_place, abs=1e-6)
    assert pose[:2] == pytest.approx(expected_pose[:2], abs=3e-5)
    assert pose[2] == pytest.approx(expected_pose[2], abs=1e-3)
    assert np.hypot(*(pose[:2] - POSE[:2])) > 2e-3


def test_without_commands_nothing_moves(predictor, slider, table) -> None:
    tip = slider.tip_position(POSE, P_Y)
    pose, place = predictor.predict(table, UNDISTURBED, POSE, tip, 0.0, DELAY)
    assert np.array_equal(pose, POSE)
    assert np.array_equal(place, tip)


def test_an_object_rests_while_the_tip_is_apart(predictor, slider, table) -> None:
    predictor.sent(rotation(POSE[2]) @ [0.08, 0.0], 0.0)
    tip = slider.tip_position(POSE, P_Y, gap=0.02)
    predictor.predict(table, UNDISTURBED, POSE, tip, 0.0, DELAY)
    pose, place = predictor.predict(table, UNDISTURBED, POSE, tip, 1.0, 1.0 + DELAY)
    assert np.array_equal(pose, POSE)
    assert np.hypot(*(place - tip)) == pytest.approx(0.08 * DELAY)


def test_an_object_rests_while_the_tip_retreats(predictor, slider, table) -> None:
    predictor.sent(rotation(POSE[2]) @ [-0.08, 0.02], 0.0)
    tip = slider.tip_position(POSE, P_Y)
    pose, _ = predictor.predict(table, UNDISTURBED, POSE, tip, 0.0, 0.3)
    assert np.array_equal(pose, POSE)


def test_after_a_reset_no_command_is_under_way(predictor, slider, table) -> None:
    tip = slider.tip_position(POSE, P_Y)
    predictor.sent(np.array([0.08, 0.0]), 0.0)
    predictor.predict(table, UNDISTURBED, POSE, tip, 1.0, 1.1)
    predictor.reset()
    pose, place = predictor.predict(table, UNDISTURBED, POSE, tip, 0.0, 0.5)
    assert np.array_equal(pose, POSE)
    assert np.array_equal(place, tip)


def test_its_horizon_is_dead_time_plus_lag(slider) -> None:
    assert Predictor(replace(ROBOT, dead_time=0.07), slider).horizon == pytest.approx(
        0.07 + ROBOT.lag
    )
