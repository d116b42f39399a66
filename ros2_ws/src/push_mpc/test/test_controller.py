"""The controller with the real plant, in process."""

import math
import signal
import threading
import time
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from push_mpc.loop.controller import Controller, Mode
from push_mpc.loop.tracker import horizon_stride
from push_mpc.plan.planning import planned
from push_mpc.settings.node_settings import mpc_settings
from push_mpc.settings.presets import with_preset

SETTINGS = mpc_settings('irb120')
MODES = {Mode.TRACKING, Mode.RECONTACT, Mode.DONE, Mode.STOPPING, Mode.STOPPED, Mode.FAULT}
ENDS = {Mode.STOPPING, Mode.STOPPED, Mode.FAULT}


def is_still(tick) -> bool:
    return not np.any(tick.velocity)


def assert_slows_down(cell, tick, last, end) -> None:
    """From the command `last` this tick and the next ones ramp down to zero, then it ends."""
    step = SETTINGS.limits.acceleration * SETTINGS.period
    for left in np.arange(np.hypot(*last) - step, 0.0, -step):
        assert (tick.mode, tick.velocity) == (
            Mode.STOPPING,
            pytest.approx(left * last / np.hypot(*last)),
        )
        tick = cell.tick()
    assert (tick.mode, is_still(tick)) == (end, True)


def test_nothing_moves_before_enough_good_poses(cell) -> None:
    ticks = [cell.tick() for _ in range(4)]
    assert [tick.mode for tick in ticks] == [Mode.ARMED] * 3 + [Mode.TRACKING]
    assert all(is_still(tick) for tick in ticks[:3])
    assert not is_still(ticks[3])


def test_the_reference_starts_when_the_object_can(cell) -> None:
    first = [cell.tick() for _ in range(4)][-1]
    assert first.reference_time == pytest.approx(-(0.109 + 0.005), abs=1e-9)
    assert first.reference == pytest.approx(cell.controller.plan.state[0], abs=1e-12)


@pytest.mark.parametrize(('preset', 'bound'), [('tuned', 0.4e-3), ('relinearised', 1e-3)])
def test_it_follows_the_plan_with_the_lag_of_the_robot(make_cell, preset, bound) -> None:
    """The flat plan, at which the tip does not roll: it is for the linearisation at the plan."""
    cell = make_cell(with_preset(replace(SETTINGS, good_poses=3), preset))
    cell.controller.arm()
    ticks = [cell.tick() for _ in range(354)][54:]
    assert {tick.mode for tick in ticks} == {Mode.TRACKING}
    references = [cell.controller.plan.at(tick.reference_time)[0] for tick in ticks]
    pairs = zip(ticks, references, strict=True)
    errors = [math.hypot(*(tick.state[:2] - reference[:2])) for tick, reference in pairs]
    assert np.mean(errors) < bound


@pytest.mark.parametrize('controller', ['gp', 'analytical'])
def test_a_weight_on_changes_makes_the_commands_smooth(make_cell, controller) -> None:
    free = replace(
        SETTINGS,
        weights=replace(SETTINGS.weights, change=0.0),
        force_weights=replace(SETTINGS.force_weights, change=0.0),
    )
    steps = []
    for chosen in (free, SETTINGS):
        cell = make_cell(replace(chosen, controller=controller))
        cell.controller.arm()
        commands = [cell.tick().velocity for _ in range(300)][100:]
        steps.append(np.sqrt(np.mean(np.diff(commands, axis=0) ** 2)))
    assert steps[1] < 0.6 * steps[0]


def test_the_prediction_comes_true(tracking) -> None:
    told = [tracking.tick() for _ in range(60)]
    predicted, later = told[0].predicted, told[12].state
    assert np.hypot(*(later[:2] - predicted[:2])) < 1.5e-3
    assert np.hypot(*(later[:2] - told[0].state[:2])) > 7e-3


@pytest.mark.parametrize('bad', [math.nan, math.inf, 1e300])
@pytest.mark.parametrize('entry', [0, 1, 2])
def test_a_bad_pose_stops_at_once_and_for_good(tracking, bad, entry) -> None:
    pose = tracking.seen.object_pose.copy()
    pose[entry] = bad
    last = tracking.tick().velocity
    assert_slows_down(tracking, tracking.tick(pose), last, Mode.STOPPED)
    assert 'pose' in tracking.controller.stop_reason
    after = [tracking.tick() for _ in range(40)]
    assert all(tick.mode == Mode.STOPPED and is_still(tick) for tick in after)
    assert np.hypot(*tracking.plant.tip_velocity) < 1e-3


def test_a_stop_is_released_by_resume_and_begins_anew(tracking) -> None:
    tracking.controller.stop('on request')
    tracking.controller.resume()
    assert tracking.controller.mode == Mode.STOPPING
    while tracking.tick().mode == Mode.STOPPING:
        pass
    tracking.controller.resume()
    assert (tracking.controller.mode, tracking.controller.stop_reason) == (Mode.IDLE, '')
    assert is_still(tracking.tick())
    tracking.controller.arm()
    assert [tracking.tick().mode for _ in range(4)] == [Mode.ARMED] * 3 + [Mode.TRACKING]


def test_resume_does_nothing_to_a_controller_that_is_not_stopped(tracking) -> None:
    tracking.controller.resume()
    assert tracking.controller.mode == Mode.TRACKING


def test_at_the_end_of_the_plan_it_slows_down_and_is_done(tracking) -> None:
    controller, last = tracking.controller, tracking.tick().velocity
    controller._reference.start -= controller.plan.duration
    assert_slows_down(tracking, tracking.tick(), last, Mode.DONE)


def test_every_command_keeps_the_limits(tracking) -> None:
    before = tracking.tick().velocity
    for _ in range(50):
        velocity = tracking.tick().velocity
        limits = SETTINGS.limits
        assert np.hypot(*velocity) <= limits.speed
        assert np.hypot(*(velocity - before)) <= limits.acceleration * 0.01 * (1 + 1e-9)
        before = velocity


def test_without_compensation_it_plans_from_what_it_sees(tracking, table) -> None:
    chosen = {'delay_compensation': False, 'good_poses': 1, 'consistent_plan': False}
    without = replace(SETTINGS, **chosen)
    controller = Controller(without, without.slider, tracking.controller.plan)
    controller.use(controller.prepare_model(table, 'table'))
    controller.arm()
    seen = tracking.seen
    for exposure in (0.0, 0.01, 0.02):
        tick = controller.step(seen.object_pose, seen.tip_position, exposure, exposure + 0.005)
    assert np.array_equal(tick.predicted, tick.state)


def test_holding_for_want_of_a_pose_is_still_and_foreseen(tracking) -> None:
    now = tracking.plant.time - tracking.plant.START
    last = tracking.tick().velocity
    held = [tracking.controller.hold(now + 0.01 * count) for count in range(15)]
    assert {tick.mode for tick in held} == {Mode.HOLDING}
    step = SETTINGS.limits.acceleration * SETTINGS.period
    assert held[0].velocity == pytest.approx(last * (1.0 - step / np.hypot(*last)))
    assert all(is_still(tick) for tick in held[1:])
    later = now + 0.15
    seen = tracking.seen
    tick = tracking.controller.step(seen.object_pose, seen.tip_position, later, later + 0.005)
    assert tick.mode == Mode.TRACKING
    assert np.hypot(*(tick.predicted[:2] - tick.state[:2])) < 2e-3


def test_without_a_pose_it_goes_on_as_predicted_and_holds_when_poses_are_too_old(
    tracking,
) -> None:
    limit = tracking.controller.settings.pose_timeout
    now, seen = tracking.plant.time - tracking.plant.START, tracking.seen
    exposure = seen.time - tracking.plant.START - 0.01
    ticks = []
    while now - exposure < limit + 0.05:
        ticks.append(tracking.controller.coast(now))
        tracking.controller.prepare_next()
        now += 0.01
    going = [tick for tick in ticks if tick.now - exposure <= limit]
    held = [tick for tick in ticks if tick.now - exposure > limit]
    assert {tick.mode for tick in going} == {Mode.TRACKING}
    assert {tick.mode for tick in held} == {Mode.HOLDING}
    speeds = [np.hypot(*tick.velocity) for tick in going]
    assert speeds == pytest.approx([0.08] * len(going), rel=0.2)
    # the prediction begins at the newest pose, wherever now is
    moved = np.hypot(*(going[-1].predicted[:2] - going[0].predicted[:2]))
    assert moved == pytest.approx(0.08 * 0.01 * (len(going) - 1), rel=0.2)
    assert all(np.isnan(tick.exposure) and tick.state is None for tick in ticks)


def test_with_half_of_the_pictures_lost_it_tracks_as_well(tracking) -> None:
    random, errors = np.random.default_rng(0), []
    for _ in range(300):
        if random.random() < 0.5:
            now = tracking.plant.time - tracking.plant.START
            tick = tracking.controller.coast(now)
            tracking.plant.command(tick.velocity, tracking.plant.time)
            tracking.seen = tracking.plant.step()
            continue
        tick = tracking.tick()
        reference, _ = tracking.controller.plan.at(tick.reference_time)
        errors.append(math.hypot(*(tick.state[:2] - reference[:2])))
    assert np.mean(errors) < 0.5e-3


def test_without_poses_only_a_run_goes_on(cell) -> None:
    controller = cell.controller
    assert (controller.coast(0.0).mode, is_still(controller.coast(0.01))) == (Mode.ARMED, True)
    controller.stop('on request')
    assert is_still(controller.coast(0.02))


def test_holding_before_the_first_pose_does_not_confuse_the_prediction(cell) -> None:
    # time has no origin yet: the present is a date
    cell.controller.hold(1.7e9)
    ticks = [cell.tick() for _ in range(30)]
    moved = ticks[-1].predicted[:2] - ticks[-1].state[:2]
    assert np.hypot(*moved) > 4e-3


def test_waiting_does_not_pile_up_commands(tracking) -> None:
    tracking.controller.stop('on request')
    for _ in range(50):
        tracking.tick()
    assert len(tracking.controller._predictor._now._queue) < 20


@pytest.mark.parametrize(('speed', 'stride'), [(0.08, 5), (0.05, 8), (0.02, 21), (0.22, 2)])
def test_the_horizon_is_a_length_of_path_at_any_speed(speed, stride) -> None:
    slow = replace(SETTINGS, speed=speed)
    assert horizon_stride(planned(slow), slow) == stride


POSES = st.tuples(
    st.one_of(st.floats(-0.5, 0.5), st.floats()),
    st.one_of(st.floats(-0.5, 0.5), st.floats()),
    st.one_of(st.floats(-7.0, 7.0), st.floats()),
).map(np.array)
TIPS = st.tuples(
    st.one_of(st.floats(-0.5, 0.5), st.floats()), st.one_of(st.floats(-0.5, 0.5), st.floats())
).map(np.array)


@settings(
    max_examples=40,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(st.lists(st.tuples(POSES, TIPS), min_size=1, max_size=2))
def test_whatever_is_seen_a_tick_ends_in_a_finite_command_or_a_stated_stop(
    cell, sightings
) -> None:
    controller = cell.controller
    cell.reset()
    controller.arm()
    for count in range(5):
        controller.step(cell.seen.object_pose, cell.seen.tip_position, 0.01 * count, 0.01 * count)
    assert controller.mode == Mode.TRACKING
    for count, (pose, tip) in enumerate(sightings):
        now = 0.06 + 0.01 * count
        tick = controller.step(pose, tip, now - 0.005, now)
        assert tick.mode in MODES
        assert np.isfinite(tick.velocity).all()
        assert np.hypot(*tick.velocity) <= SETTINGS.limits.speed * (1 + 1e-12)
        assert bool(controller.stop_reason) == (tick.mode in ENDS)
        if tick.mode in (Mode.STOPPED, Mode.FAULT):
            assert is_still(tick)


@pytest.mark.parametrize('controller', ['gp', 'analytical'])
def test_no_ctrl_c_is_lost_while_the_solver_has_a_handler_of_its_own(
    make_cell, controller
) -> None:
    cell = make_cell(replace(SETTINGS, controller=controller))
    cell.controller.arm()
    main, presses, taken = threading.get_ident(), 40, 0
    for press in range(presses):
        # to this thread: the test runner has another one
        timer = threading.Timer(1e-4 * press, signal.pthread_kill, (main, signal.SIGINT))
        try:
            timer.start()
            end = time.monotonic() + 5.0
            while time.monotonic() < end:
                cell.tick()
        except KeyboardInterrupt:
            taken += 1
    assert taken == presses
