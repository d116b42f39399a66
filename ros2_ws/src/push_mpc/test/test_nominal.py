"""The flat plan, held to the motion equations of the motion cone, which it was not made with."""

import math
from dataclasses import replace

import numpy as np
import pytest
from push_core.physics.motion_cone import ContactMode, MotionCone
from push_core.tracks.arc_track import ArcTrack
from push_core.tracks.built_in import by_name
from push_core.tracks.spline_track import SplineTrack
from push_mpc.motion.dynamics import rates
from push_mpc.plan.nominal import TooTightError, flat_plan
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

SPEED = 0.08
FINE = 1e-3
WINDOW = 0.2


@pytest.fixture(scope='module')
def sticky(slider):
    """A point contact that sticks on any of our tracks; the plan knows nothing of friction."""
    return replace(slider, tip_radius=0.0, friction_pusher=0.6)


def fine_plan(name, slider):
    return flat_plan(by_name(name), SPEED, slider, laps=1, period=FINE, overrun=0.5)


def integrated(slider, plan, first, last):
    """State (4,) at sample `last`, from that at `first`, by the motion cone under the input."""
    inputs = CubicSpline(plan.time[first : last + 1], plan.input[first : last + 1])

    def motion(time, state):
        return rates(MotionCone(slider), state[None], inputs(time)[None], slider.tip_x)[0]

    span = plan.time[first], plan.time[last]
    return solve_ivp(motion, span, plan.state[first], 'DOP853', rtol=1e-12, atol=1e-14).y[:, -1]


@pytest.mark.parametrize('name', ['eight', 'square', 'line'])
def test_the_plan_satisfies_the_motion_equations_to_1e_9(name, sticky) -> None:
    plan, jumps = fine_plan(name, sticky), by_name(name).breakpoints / SPEED
    length = round(WINDOW / FINE)
    begins = np.arange(0, round(plan.duration / FINE) - length, length)
    begin, end = plan.time[begins, None], plan.time[begins + length, None]
    # no spline follows a kink of the input
    kinked = np.any((jumps > begin - FINE) & (jumps < end + FINE), axis=1)
    smooth = begins[~kinked]
    assert smooth.size >= 6
    for first in smooth[:: max(smooth.size // 8, 1)]:
        reached = integrated(sticky, plan, first, first + length)
        assert np.allclose(reached, plan.state[first + length], rtol=0, atol=1e-9)


def test_a_wrong_side_slip_would_be_noticed(sticky) -> None:
    plan = fine_plan('eight', sticky)
    plan.state[:, 2] += 1e-6
    reached = integrated(sticky, plan, 1000, 1200)
    assert np.abs(reached - plan.state[1200]).max() > 1e-9


@pytest.mark.parametrize('name', ['eight', 'square'])
def test_the_contact_sticks_all_along_with_enough_friction(name, sticky) -> None:
    plan = fine_plan(name, sticky)
    v_n, v_t = plan.input.T
    mode = MotionCone(sticky).mode(plan.state[:, 3], np.arctan2(v_n, v_t))
    assert np.all(mode == ContactMode.STICKING)
    assert not plan.state[:, 3].any()


def test_the_centre_follows_the_track_at_its_speed(eight) -> None:
    x, y, heading, _ = by_name('eight').at(SPEED * eight.time)
    assert np.allclose(eight.state[:, :2], np.stack([x, y], axis=-1), rtol=0, atol=1e-15)
    side_slip = heading - eight.state[:, 2]
    assert np.abs(side_slip).max() < math.radians(15.0)


def test_on_a_long_circle_the_side_slip_settles_where_it_balances(slider) -> None:
    radius, slip_length = 0.15, slider.support_radius**2 / 0.045
    circle = ArcTrack('circle', [(2 * math.pi * radius, 1.0 / radius)], heading=0.0, closed=True)
    plan = flat_plan(circle, SPEED, slider, laps=2, period=0.01, overrun=1.0)
    _, _, heading, _ = circle.at(SPEED * plan.time)
    balance = -math.asin(slip_length / radius)
    assert np.allclose(heading - plan.state[:, 2], balance, rtol=0, atol=1e-12)


def test_the_plan_looks_ahead_it_turns_before_the_corner(slider) -> None:
    track = by_name('square')
    plan = flat_plan(track, SPEED, slider, laps=1, period=0.01, overrun=1.0)
    corner = track.breakpoints[1] / SPEED
    state, _ = plan.at(corner - 0.1)
    assert abs(state[2]) > math.radians(5.0)


@pytest.mark.parametrize('laps', [2, 3])
def test_the_laps_repeat_and_the_heading_goes_on(slider, laps) -> None:
    track = by_name('square')
    lap = track.length / SPEED
    plan = flat_plan(track, SPEED, slider, laps, period=lap / 1000, overrun=0.5)
    assert plan.duration == pytest.approx(laps * lap)
    first, second = plan.state[:900], plan.state[1000:1900]
    assert np.allclose(second - first, [0.0, 0.0, 2 * math.pi, 0.0], rtol=0, atol=1e-9)
    assert np.allclose(plan.input[:900], plan.input[1000:1900], rtol=0, atol=1e-10)


def test_an_open_track_goes_straight_on_for_the_horizon(slider) -> None:
    plan = flat_plan(by_name('line'), SPEED, slider, laps=1, period=0.01, overrun=1.0)
    assert plan.duration == pytest.approx(0.5 / SPEED)
    assert plan.time[-1] >= plan.duration + 1.0
    assert np.allclose(plan.state[:, 0], SPEED * plan.time, rtol=0, atol=1e-15)
    assert np.allclose(plan.input, [SPEED, 0.0], rtol=0, atol=1e-15)


def test_too_tight_a_turn_is_refused_with_its_place(slider) -> None:
    pieces = [(0.3, 0.0), (0.06, 1.0 / 0.02), (0.3, 0.0)]
    tight = ArcTrack('hairpin', pieces, heading=0.0, closed=False)
    with pytest.raises(TooTightError, match='track hairpin turns too tightly near') as caught:
        flat_plan(tight, SPEED, slider, laps=1, period=0.01, overrun=1.0)
    place = float(str(caught.value).split('near ')[1].split(' mm')[0])
    assert 270.0 < place < 360.0


@pytest.mark.parametrize('radius', [0.004, 0.008, 0.013, 0.018, 0.03, 0.06])
def test_a_circle_tighter_than_friction_holds_is_refused(slider, radius) -> None:
    tight = ArcTrack('ring', [(2.0 * math.pi * radius, 1.0 / radius)], heading=0.0, closed=True)
    with pytest.raises(TooTightError, match='track ring turns too tightly'):
        flat_plan(tight, 0.02, slider, laps=1, period=0.01, overrun=1.0)


def test_a_track_that_turns_back_on_itself_is_refused_with_its_place(slider) -> None:
    there = np.linspace(0.0, 0.2, 21)
    back = np.concatenate([there, there[-2::-1]])
    hairpin = SplineTrack('hairpin', np.column_stack([back, np.zeros_like(back)]))
    with pytest.raises(TooTightError, match='track hairpin turns too tightly near 200 mm'):
        flat_plan(hairpin, SPEED, slider, laps=1, period=0.01, overrun=1.0)


def test_between_samples_the_plan_is_interpolated_and_beyond_its_ends_held(eight) -> None:
    state, inputs = eight.at(0.125)
    assert np.allclose(state, 0.5 * (eight.state[12] + eight.state[13]), rtol=0, atol=1e-12)
    assert np.allclose(inputs, 0.5 * (eight.input[12] + eight.input[13]), rtol=0, atol=1e-12)
    for time, sample in ((-1.0, 0), (1e4, -1)):
        assert np.array_equal(eight.at(time)[0], eight.state[sample])
        assert np.array_equal(eight.at(time)[1], eight.input[sample])


@pytest.mark.parametrize(('share', 'pushable'), [(1.02, True), (0.98, False)])
def test_the_tightest_circle_is_the_one_on_the_edge_of_the_friction_cone(
    slider, share, pushable
) -> None:
    # c^2 / |p_x| over the sine of the cone's half angle
    radius = (
        share
        * slider.support_radius**2
        / abs(slider.p_x)
        * math.hypot(1.0, 1.0 / slider.friction_pusher)
    )
    circle = ArcTrack('ring', [(2.0 * math.pi * radius, 1.0 / radius)], heading=0.0, closed=True)
    if pushable:
        flat_plan(circle, SPEED, slider, laps=1, period=0.01, overrun=0.5)
        return
    with pytest.raises(TooTightError, match='the smallest radius is 74 mm'):
        flat_plan(circle, SPEED, slider, laps=1, period=0.01, overrun=0.5)
