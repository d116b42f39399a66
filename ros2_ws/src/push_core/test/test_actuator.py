import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from push_core.physics.actuator import ACTUATORS, Actuator, ActuatorSettings

STEP = 0.001
SLOW = ActuatorSettings(dead_time=0.06, lag=0.05)
SPEEDS = st.floats(-1.0, 1.0)


def driven(settings, commands, duration, step=STEP):
    """Velocity at the end of each step and position (n, 2) under timed commands [(time, v)]."""
    actuator, place = Actuator(settings), np.zeros(2)
    velocities, places = [], []
    for arrival, velocity in commands:
        actuator.command(np.array(velocity), arrival)
    for index in range(round(duration / step)):
        place = place + step * np.array(actuator.advance(index * step, step))
        velocities.append(actuator.velocity)
        places.append(place)
    return np.array(velocities), np.array(places)


def step_response(t, speed, settings):
    """Closed form of velocity and position after a step command at t = 0, without limits."""
    since = np.maximum(t - settings.dead_time, 0.0)
    risen = 1.0 - np.exp(-since / settings.lag)
    return speed * risen, speed * (since - settings.lag * risen)


@pytest.mark.parametrize('step', [0.001, 0.005, 0.01])
def test_the_step_response_is_the_closed_form_at_any_step(step) -> None:
    velocities, places = driven(SLOW, [(0.0, (0.08, 0.0))], 0.5, step)
    velocity, place = step_response(step * np.arange(1, len(places) + 1), 0.08, SLOW)
    assert np.allclose(velocities[:, 0], velocity, rtol=0, atol=1e-14)
    assert np.allclose(places[:, 0], place, rtol=0, atol=1e-14)
    assert not velocities[:, 1].any()


@pytest.mark.parametrize('step', [0.004, 0.007, 0.01])
def test_a_command_acts_after_the_dead_time_also_within_a_step(step) -> None:
    shifted = 0.0033
    velocities, places = driven(SLOW, [(shifted, (0.08, 0.0))], 0.35, step)
    ends = step * np.arange(1, len(places) + 1) - shifted
    velocity, place = step_response(ends, 0.08, SLOW)
    assert np.allclose(velocities[:, 0], velocity, rtol=0, atol=1e-14)
    assert np.allclose(places[:, 0], place, rtol=0, atol=1e-14)


def test_nothing_moves_during_the_dead_time() -> None:
    velocities, _ = driven(SLOW, [(0.0, (0.08, 0.04))], 0.2)
    moving = np.any(velocities != 0.0, axis=1)
    assert np.argmax(moving) == round(SLOW.dead_time / STEP)


def test_dead_time_and_lag_are_found_again_in_a_step_response() -> None:
    velocities, places = driven(SLOW, [(0.0, (0.08, 0.0))], 1.0)
    # far behind the step the tip trails a tip without lag by dead time plus lag
    trail = 1.0 - places[-1, 0] / 0.08
    assert trail == pytest.approx(SLOW.dead_time + SLOW.lag, abs=1e-3)
    at_63_percent = STEP * (1 + np.argmax(velocities[:, 0] >= 0.08 * (1.0 - math.exp(-1.0))))
    assert at_63_percent == pytest.approx(SLOW.dead_time + SLOW.lag, abs=1e-3)


def test_commands_act_one_after_the_other_as_late_as_they_arrived() -> None:
    ideal_but_late = ActuatorSettings(dead_time=0.05, lag=0.0, acceleration_limit=100.0)
    commands = [(0.0, (0.04, 0.0)), (0.02, (0.0, 0.05))]
    velocities, _ = driven(ideal_but_late, commands, 0.1)
    assert velocities[49] == pytest.approx([0.0, 0.0])
    assert velocities[60] == pytest.approx([0.04, 0.0])
    assert velocities[80] == pytest.approx([0.0, 0.05])


def test_the_ideal_robot_is_at_speed_at_once() -> None:
    velocities, _ = driven(ACTUATORS['ideal'], [(0.0, (0.08, 0.0))], 0.01)
    assert velocities[0] == pytest.approx([0.08, 0.0])


def test_too_fast_a_command_keeps_its_direction() -> None:
    velocities, _ = driven(SLOW, [(0.0, (3.0, 4.0))], 2.0)
    assert velocities[-1] == pytest.approx([0.15, 0.2], abs=1e-12)


@given(st.lists(st.tuples(SPEEDS, SPEEDS), max_size=20))
def test_speed_and_acceleration_never_exceed_their_limits(commands) -> None:
    timed = [(0.01 * index, velocity) for index, velocity in enumerate(commands)]
    velocities, _ = driven(SLOW, timed, 0.4, step=0.005)
    assert np.all(np.hypot(*velocities.T) <= SLOW.speed_limit * (1.0 + 1e-12))
    changes = np.diff(velocities, axis=0, prepend=0.0)
    assert np.all(np.hypot(*changes.T) <= SLOW.acceleration_limit * 0.005 * (1.0 + 1e-12))


def test_braking_stops_within_the_braking_distance_and_forgets_commands() -> None:
    actuator = Actuator(SLOW)
    actuator.command(np.array([0.2, 0.0]), 0.0)
    for index in range(500):
        actuator.advance(index * STEP, STEP)
    actuator.command(np.array([0.0, 0.2]), 0.5)
    speed = actuator.velocity[0]
    distance = sum(actuator.brake(STEP)[0] for _ in range(200)) * STEP
    assert not actuator.velocity.any()
    assert distance == pytest.approx(speed**2 / (2.0 * SLOW.deceleration_limit), abs=1e-7)
    assert actuator.advance(0.7, STEP) == (0.0, 0.0)


def test_a_copy_goes_its_own_way() -> None:
    original, copy = Actuator(SLOW), Actuator(SLOW)
    original.command(np.array([0.08, 0.0]), 0.0)
    original.advance(0.0, 0.1)
    original.command(np.array([0.0, 0.05]), 0.1)
    copy.copy_state(original)
    after = [copy.advance(0.1 + 0.01 * index, 0.01) for index in range(20)]
    copy.command(np.array([-0.1, -0.1]), 0.3)
    assert [original.advance(0.1 + 0.01 * index, 0.01) for index in range(20)] == after
    assert original.advance(0.5, 0.01) != copy.advance(0.5, 0.01)


def test_a_reset_robot_is_at_rest_with_nothing_under_way() -> None:
    actuator = Actuator(SLOW)
    actuator.command(np.array([0.08, 0.0]), 0.0)
    actuator.advance(0.2, 0.1)
    actuator.command(np.array([0.08, 0.0]), 0.3)
    actuator.reset()
    assert actuator.advance(1.0, 0.1) == (0.0, 0.0)
    assert not actuator.velocity.any()
