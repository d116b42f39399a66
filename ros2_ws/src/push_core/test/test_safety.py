import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from push_core.physics.actuator import ACTUATORS, Actuator
from push_core.physics.safety import (
    ACCELERATION,
    DEAD_BAND,
    LIMIT_NAMES,
    NOT_FINITE,
    SPEED,
    WORKSPACE,
    SafetyLimits,
    limit,
    slowed,
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
    bits = [NOT_FINITE, SPEED, ACCELERATION, WORKSPACE, DEAD_BAND]
    assert sorted(LIMIT_NAMES) == bits
    assert [bit & (bit - 1) for bit in bits] == [0] * len(bits)


@pytest.mark.parametrize('tiny', [5e-324, 1e-300, 0.9e-5])
def test_what_is_slower_than_the_dead_band_is_sent_as_zero(tiny) -> None:
    velocity, bits = limited([tiny, 0.0])
    assert (velocity.tolist(), bits) == ([0.0, 0.0], DEAD_BAND)
    assert limited([0.0, 0.0]) == (pytest.approx([0.0, 0.0]), 0)


@pytest.mark.parametrize('huge', [1e308, -1e308, 1.7976931348623157e308])
def test_numbers_whose_difference_overflows_stop(huge) -> None:
    velocity, bits = limited([huge, 0.0], previous=[-huge, 0.0])
    assert (velocity.tolist(), bits) == ([0.0, 0.0], NOT_FINITE)


# numbers of every kind, and near every threshold
ODD = st.sampled_from(
    [0.0, -0.0, 5e-324, -5e-324, 1e-300, 1e-5, 1e308, -1e308, math.nan, math.inf, -math.inf]
)
NUMBERS = st.one_of(st.floats(-0.3, 0.3), st.floats(-0.7, 0.7), st.floats(), ODD)
VECTORS = st.tuples(NUMBERS, NUMBERS).map(np.array)


@given(VECTORS, VECTORS, VECTORS)
@example(np.zeros(2), np.array([1.0, 0.0]), np.array([1.0, 0.0]))
def test_whatever_is_asked_the_command_keeps_every_limit_and_says_which(
    velocity, previous, position
) -> None:
    given_bytes = velocity.tobytes(), previous.tobytes(), position.tobytes()
    command, bits = limit(velocity, previous, position, LIMITS, PERIOD)
    assert (velocity.tobytes(), previous.tobytes(), position.tobytes()) == given_bytes
    assert np.isfinite(command).all()
    speed = math.hypot(*command)
    assert speed <= LIMITS.speed * (1.0 + 1e-12)
    assert speed == 0.0 or speed >= LIMITS.dead_band
    if bits & NOT_FINITE:
        assert not command.any()
        return
    edges = np.array([LIMITS.workspace_x, LIMITS.workspace_y])
    room = np.maximum(edges - BLIND - np.sign(command) * position, 0.0)
    assert np.all(np.abs(command) <= np.sqrt(2.0 * LIMITS.deceleration * room) * (1.0 + 1e-12))
    if not bits & (WORKSPACE | DEAD_BAND) and math.hypot(*previous) <= LIMITS.speed:
        step = LIMITS.acceleration * PERIOD
        assert math.hypot(*(command - previous)) <= step * (1.0 + 1e-9) + 1e-15
    # one limit may undo another, so that bits do not mean that the command differs
    assert bits or np.array_equal(command, velocity)


@given(st.floats(0.01, 1e5), st.floats(-math.pi, math.pi))
def test_the_speed_limit_keeps_the_direction(speed, angle) -> None:
    asked = speed * np.array([math.cos(angle), math.sin(angle)])
    command, _ = limit(asked, asked, CENTRE, LIMITS, PERIOD)
    assert math.hypot(*command) == pytest.approx(min(speed, LIMITS.speed))
    across = command[0] * asked[1] - command[1] * asked[0]
    assert abs(across) <= 1e-12 * speed
    assert command @ asked > 0.0


@given(VECTORS)
def test_slowing_down_ends_at_zero_along_a_line_with_the_stated_deceleration(previous) -> None:
    velocity, bits = slowed(previous, LIMITS, PERIOD)
    assert np.isfinite(velocity).all()
    if bits & NOT_FINITE:
        assert not velocity.any()
        return
    before, step = math.hypot(*previous), LIMITS.acceleration * PERIOD
    after = math.hypot(*velocity)
    assert after == pytest.approx(max(before - step, 0.0), abs=1e-9 * max(before, 1.0))
    assert velocity.any() == (before > step)


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


def rest_after(speed: float, next_command) -> float:
    """Time [s] from the first command of a stop until a robot at a speed [m/s] moves by 5 mm/s."""
    robot, step = Actuator(ACTUATORS['irb120']), PERIOD / 10
    for tick in range(-100, 0):
        robot.command(np.array([speed, 0.0]), tick * PERIOD)
        robot.advance(tick * PERIOD, PERIOD)
    sent, rest = np.array([speed, 0.0]), 0.0
    for tick in range(100):
        sent = next_command(sent)
        robot.command(sent, tick * PERIOD)
        for part in range(10):
            robot.advance(tick * PERIOD + part * step, step)
            if robot.velocity[0] > 0.005:
                rest = tick * PERIOD + (part + 1) * step
    return rest


@pytest.mark.parametrize(
    ('speed', 'stated'), [(0.02, 0.13), (0.05, 0.18), (0.08, 0.21), (0.15, 0.25), (0.25, 0.28)]
)
def test_a_stop_takes_the_time_that_the_page_on_operating_states(speed, stated) -> None:
    robot, limits = ACTUATORS['irb120'], SafetyLimits()
    ramp = limits.acceleration * robot.lag
    reached = ramp * (math.exp(speed / ramp) - 1.0)
    bound = robot.dead_time + robot.lag * math.log(reached / 0.005)
    taken = rest_after(speed, lambda sent: slowed(sent, limits, PERIOD)[0])
    assert bound - 0.01 < taken <= bound + 0.001
    assert stated - 0.01 < bound <= stated


def test_no_command_without_reversing_stops_the_fastest_robot_within_a_quarter_of_a_second() -> (
    None
):
    assert rest_after(0.25, lambda _: STILL) > 0.25
