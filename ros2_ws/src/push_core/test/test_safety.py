import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from push_core.physics.actuator import ACTUATORS, Actuator
from push_core.physics.safety import (
    ACCELERATION,
    LIMIT_NAMES,
    NOT_FINITE,
    SPEED,
    WORKSPACE,
    SafetyLimits,
    limit,
)

PERIOD = 0.01
CENTRE = np.zeros(2)
STILL = np.zeros(2)
LIMITS = SafetyLimits(
    speed=0.2,
    acceleration=4.0,
    deceleration=2.0,
    reaction_time=0.1,
    workspace_x=0.5,
    workspace_y=0.4,
)
BLIND = LIMITS.speed * LIMITS.reaction_time
ANY = st.floats(allow_nan=True, allow_infinity=True)
PAIRS = st.tuples(ANY, ANY).map(np.array)


def limited(velocity, previous=STILL, position=CENTRE):
    return limit(np.array(velocity), np.array(previous), np.array(position), LIMITS, PERIOD)


def test_a_modest_command_passes_bit_for_bit() -> None:
    velocity, bits = limited([0.03, -0.02], previous=[0.02, -0.01])
    assert velocity.tolist() == [0.03, -0.02]
    assert bits == 0


@pytest.mark.parametrize('bad', [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize('argument', ['velocity', 'previous', 'position'])
def test_anything_that_is_not_finite_stops(bad, argument) -> None:
    arguments = {'velocity': [0.01, 0.0], 'previous': [0.0, 0.0], 'position': [0.0, 0.0]}
    arguments[argument] = [0.0, bad]
    velocity, bits = limited(**arguments)
    assert velocity.tolist() == [0.0, 0.0]
    assert bits == NOT_FINITE


def test_too_fast_a_command_keeps_its_direction() -> None:
    velocity, bits = limited([0.3, -0.4], previous=[0.12, -0.16])
    assert velocity == pytest.approx([0.12, -0.16])
    assert bits == SPEED | ACCELERATION


@pytest.mark.parametrize('sign', [1.0, -1.0])
@pytest.mark.parametrize('axis', [0, 1])
def test_speeding_up_is_limited_in_every_direction(axis, sign) -> None:
    wanted = sign * 0.1 * np.eye(2)[axis]
    velocity, bits = limited(wanted)
    assert velocity == pytest.approx(0.4 * wanted)
    assert bits == ACCELERATION


@pytest.mark.parametrize('sign', [1.0, -1.0])
def test_slowing_down_and_reversing_are_limited_as_well(sign) -> None:
    slower, bits = limited([0.0, 0.0], previous=[sign * 0.1, 0.0])
    assert slower == pytest.approx([sign * 0.06, 0.0])
    assert bits == ACCELERATION
    reversing, _ = limited([-sign * 0.1, 0.0], previous=[sign * 0.02, 0.0])
    assert reversing == pytest.approx([-sign * 0.02, 0.0])


@pytest.mark.parametrize('sign', [1.0, -1.0])
@pytest.mark.parametrize(('axis', 'edge'), [(0, 0.5), (1, 0.4)])
def test_near_an_edge_it_goes_no_faster_than_it_can_stop(axis, edge, sign) -> None:
    outwards = sign * np.eye(2)[axis]
    room = 0.001
    velocity, bits = limited(
        0.1 * outwards, previous=0.1 * outwards, position=(edge - BLIND - room) * outwards
    )
    assert velocity == pytest.approx(math.sqrt(2.0 * LIMITS.deceleration * room) * outwards)
    assert bits == WORKSPACE


@pytest.mark.parametrize('sign', [1.0, -1.0])
@pytest.mark.parametrize(('axis', 'edge'), [(0, 0.5), (1, 0.4)])
def test_at_and_beyond_an_edge_it_may_only_return(axis, edge, sign) -> None:
    outwards = sign * np.eye(2)[axis]
    for place in (edge - BLIND, edge, edge + 0.1):
        leaving, _ = limited(0.03 * outwards, previous=0.03 * outwards, position=place * outwards)
        assert leaving.tolist() == [0.0, 0.0]
        returning, bits = limited(-0.03 * outwards, position=place * outwards)
        assert returning == pytest.approx(-0.03 * outwards)
        assert bits == 0


def test_an_edge_ahead_does_not_hinder_the_way_along_it() -> None:
    velocity, bits = limited([0.03, 0.03], previous=[0.03, 0.03], position=[0.5, 0.0])
    assert velocity.tolist() == [0.0, 0.03]
    assert bits == WORKSPACE


def test_the_workspace_comes_last_and_may_brake_harder_than_the_acceleration_limit() -> None:
    velocity, bits = limited([0.2, 0.0], previous=[0.2, 0.0], position=[0.5, 0.0])
    assert velocity.tolist() == [0.0, 0.0]
    assert bits == WORKSPACE


def test_the_speed_limit_comes_after_the_acceleration_limit() -> None:
    # a full step of acceleration towards the command ends too fast
    velocity, bits = limited([0.2, 0.2], previous=[0.16, 0.12])
    assert math.hypot(*velocity) == pytest.approx(LIMITS.speed)
    assert bits == SPEED | ACCELERATION


def test_every_bit_has_a_name_and_no_other() -> None:
    assert sorted(LIMIT_NAMES) == [NOT_FINITE, SPEED, ACCELERATION, WORKSPACE]
    assert sum(LIMIT_NAMES) == NOT_FINITE | SPEED | ACCELERATION | WORKSPACE


@given(PAIRS, PAIRS, PAIRS)
@example(np.zeros(2), np.array([1.0, 0.0]), np.array([1.0, 0.0]))
def test_whatever_is_asked_the_command_is_finite_and_within_the_speed_limit(
    velocity, previous, position
) -> None:
    command, bits = limit(velocity, previous, position, LIMITS, PERIOD)
    assert np.isfinite(command).all()
    assert math.hypot(*command) <= LIMITS.speed * (1.0 + 1e-12)
    # one limit may undo another, so that bits do not mean that the command differs
    assert bits or np.array_equal(command, velocity)


SPEEDS = st.floats(-0.3, 0.3)
STRETCHES = st.lists(st.tuples(SPEEDS, SPEEDS, st.integers(1, 40)), min_size=1, max_size=8)


@settings(max_examples=50)
@given(STRETCHES, st.floats(-0.55, 0.55), st.floats(-0.55, 0.55))
def test_a_robot_with_its_lag_never_leaves_the_workspace(stretches, x, y) -> None:
    limits, robot = SafetyLimits(), Actuator(ACTUATORS['irb120'])
    place, sent, tick = np.array([x, y]), STILL, 0
    for v_x, v_y, ticks in (*stretches, (0.25, 0.25, 60)):
        for _ in range(ticks):
            sent, _ = limit(np.array([v_x, v_y]), sent, place, limits, PERIOD)
            robot.command(sent, tick * PERIOD)
            place = place + PERIOD * np.array(robot.advance(tick * PERIOD, PERIOD))
            tick += 1
            assert np.all(np.abs(place) <= [limits.workspace_x, limits.workspace_y])
