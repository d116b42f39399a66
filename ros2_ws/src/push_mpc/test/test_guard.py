"""What ends a run (a failing solver, a lost object, frozen cameras), and what only pauses it."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.geometry import to_world
from push_mpc.loop.modes import Mode
from push_mpc.qp.steering import Move
from push_mpc.settings.node_settings import mpc_settings

GUARD = mpc_settings('irb120').guard
NOTHING = Move(np.full(2, np.nan), 3, 7, fault='v_n is violated by 0.1', states=np.empty((0, 4)))


def ended(cell, pose=None, most=200):
    """Ticks until the run has ended, with the first mode and the largest command of each."""
    ticks = []
    while (tick := cell.tick(pose)).mode not in (Mode.STOPPED, Mode.FAULT):
        ticks.append(tick)
        assert len(ticks) < most
    return ticks


def raises(*_problem):
    raise ArithmeticError('singular')


@pytest.mark.parametrize('solve', [lambda *_problem: NOTHING, raises])
def test_a_solver_without_an_answer_slows_the_tip_down_and_fails_after_some_ticks(
    tracking, monkeypatch, solve
) -> None:
    before = np.hypot(*tracking.tick().velocity)
    monkeypatch.setattr(tracking.controller._tracker.steering, 'solve', solve)
    step = 0.05
    for count in range(1, GUARD.solver_failures):
        tick = tracking.tick()
        assert tick.mode == Mode.TRACKING
        assert np.hypot(*tick.velocity) == pytest.approx(max(before - count * step, 0.0))
    tick = tracking.tick()
    assert (tick.mode, tick.velocity.any()) == (Mode.FAULT, False)
    assert 'the solver found no usable input in 5 ticks in a row' in (
        tracking.controller.stop_reason
    )
    assert tracking.controller.solver_failures == GUARD.solver_failures


def test_a_solver_that_fails_now_and_then_costs_a_tick_each(tracking, monkeypatch) -> None:
    steering = tracking.controller._tracker.steering
    healthy, calls = steering.solve, []

    def fickle(*problem):
        calls.append(1)
        return NOTHING if len(calls) % 10 < 3 else healthy(*problem)

    monkeypatch.setattr(steering, 'solve', fickle)
    ticks = [tracking.tick() for _ in range(200)]
    assert {tick.mode for tick in ticks} == {Mode.TRACKING}
    assert tracking.controller.solver_failures == 60
    assert distance(tracking, ticks[-1]) < 5e-3


def distance(cell, tick) -> float:
    reference, _ = cell.controller.plan.at(tick.reference_time)
    return float(np.hypot(*(tick.state[:2] - reference[:2])))


def test_an_object_that_is_lost_stops_the_run_with_the_distance(tracking) -> None:
    pose = tracking.plant.object_pose
    pose[:2] = to_world(pose, np.array([0.0, 0.2]))
    ticks = ended(tracking, pose)
    assert len(ticks) < 5
    assert tracking.controller.stop_reason == 'the object is 200 mm from its reference'


def test_a_reference_may_be_missed_by_less(make_cell) -> None:
    settings = replace(mpc_settings('irb120'), good_poses=3)
    cell = make_cell(settings)
    cell.controller.arm()
    for _ in range(20):
        cell.tick()
    pose = cell.plant.object_pose
    pose[:2] = to_world(pose, np.array([0.03, 0.0]))
    cell.plant._world.place_object(pose)
    assert Mode.STOPPED not in [cell.tick().mode for _ in range(100)]


def test_cameras_that_freeze_stop_the_run(tracking) -> None:
    frozen, controller = tracking.seen, tracking.controller
    modes = []
    for _ in range(60):
        exposure, now = (
            time - tracking.plant.START for time in (tracking.seen.time, tracking.plant.time)
        )
        tick = controller.step(frozen.object_pose, frozen.tip_position, exposure, now)
        tracking.plant.command(tick.velocity, tracking.plant.time)
        tracking.seen = tracking.plant.step()
        modes.append(tick.mode)
    assert modes.index(Mode.STOPPING) == pytest.approx(GUARD.frozen / 0.01, abs=2)
    assert 'the poses have not changed for' in controller.stop_reason


def test_an_object_at_rest_without_noise_is_not_frozen_while_nothing_is_commanded(
    make_cell,
) -> None:
    cell = make_cell(replace(mpc_settings('irb120'), good_poses=100))
    cell.controller.arm()
    pose, tip = cell.seen.object_pose, cell.seen.tip_position
    ticks = [cell.controller.step(pose, tip, 0.01 * n, 0.01 * n + 0.005) for n in range(105)]
    assert ticks[-1].mode == Mode.TRACKING


def test_a_camera_of_the_object_that_freezes_alone_stops_the_run(tracking) -> None:
    frozen = tracking.seen.object_pose
    ended(tracking, frozen)
    assert 'mm inside the object' in tracking.controller.stop_reason


def paused(cell, ticks: int, hold: bool):
    """No pose for some ticks; with or without holds, as when the controller itself was away."""
    for _ in range(ticks):
        if hold:
            tick = cell.controller.hold(cell.plant.time - cell.plant.START)
            cell.plant.command(tick.velocity, cell.plant.time)
        cell.seen = cell.plant.step()


@pytest.mark.parametrize('hold', [True, False])
@pytest.mark.parametrize('ticks', [20, 100])
def test_after_a_pause_the_reference_goes_on_from_where_the_object_lies(
    tracking, ticks, hold
) -> None:
    before = tracking.tick().reference_time
    paused(tracking, ticks, hold)
    first = tracking.tick()
    # the reference waits until the first command acts, and the tip had come to rest
    assert first.mode == Mode.TRACKING
    assert before < first.reference_time < before + 0.3
    later = [tracking.tick() for _ in range(150)]
    assert later[8].reference_time == first.reference_time
    assert later[-1].reference_time == pytest.approx(first.reference_time + 1.5 - 0.11, abs=0.02)
    errors = [distance(tracking, tick) for tick in (first, *later)]
    assert max(errors) < 4e-3
    assert np.mean(errors[-50:]) < 0.8e-3


@pytest.mark.parametrize('ticks', [2, 5])
def test_a_short_dropout_moves_no_reference_and_costs_little(tracking, ticks) -> None:
    before = tracking.tick().reference_time
    paused(tracking, ticks, hold=True)
    after = [tracking.tick() for _ in range(100)]
    assert after[0].reference_time == pytest.approx(before + 0.01 * (ticks + 1))
    assert np.mean([distance(tracking, tick) for tick in after]) < 1.5e-3


def test_a_silence_longer_than_the_drivers_timeout_is_foreseen(tracking) -> None:
    tracking.tick()
    paused(tracking, 12, hold=False)
    braked = np.hypot(*tracking.plant.tip_velocity)
    tracking.tick()
    assert braked < 0.02
    assert np.hypot(*tracking.controller._predictor._now.velocity) == pytest.approx(
        braked, abs=0.02
    )
