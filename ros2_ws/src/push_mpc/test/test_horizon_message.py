"""The planned horizon, as a message."""

import numpy as np
import pytest
from push_mpc.loop.controller import Mode
from push_mpc.node.horizon_message import HorizonMessage
from push_sim.settings.plant_settings import PerturbationKind


@pytest.fixture
def message(tracking):
    settings = tracking.controller.settings
    return HorizonMessage(settings.horizon_steps, tracking.controller.horizon_step)


def poses(horizon):
    return np.column_stack([horizon.x, horizon.y, horizon.theta])


def test_it_begins_at_the_predicted_state_and_ends_on_the_reference(tracking, message) -> None:
    ticks = [tracking.tick() for _ in range(60)]
    planned = poses(message.of(ticks[-1].planned, 7))
    settings = tracking.controller.settings
    assert planned.shape == (settings.horizon_steps + 1, 3)
    assert np.abs(planned[0] - ticks[-1].predicted[:3]).max() < 1e-3
    wanted = tracking.controller.plan.state[ticks[-1].planned.samples[-1], :2]
    assert np.abs(planned[-1, :2] - wanted).max() < 2e-3
    length = np.hypot(*np.diff(planned[:, :2], axis=0).T).sum()
    assert length == pytest.approx(settings.horizon_length, rel=0.05)


def test_the_plan_comes_true_while_a_kick_is_made_good(tracking, message) -> None:
    for _ in range(60):
        tracking.tick()
    tracking.disturb(PerturbationKind.NORMAL, 0.004)
    ticks = [tracking.tick() for _ in range(25)]
    horizon = message.of(ticks[-1].planned, 7)
    planned, ahead = poses(horizon), 10
    wait = 12 + round(ahead * horizon.step / 0.01)
    later = [tracking.tick() for _ in range(wait)][-1].state
    assert np.hypot(*(later[:2] - planned[ahead, :2])) < 2e-3
    assert np.hypot(*(later[:2] - planned[0, :2])) > 15e-3


def test_the_message_is_filled_in_place(tracking, message) -> None:
    first, second = tracking.tick(), [tracking.tick() for _ in range(40)][-1]
    told = message.of(first.planned or second.planned, 1)
    numbers = told.x
    again = message.of(second.planned, 2_000_000_003)
    assert again is told
    assert again.x is numbers
    assert (again.header.stamp.sec, again.header.stamp.nanosec) == (2, 3)


def test_a_tick_that_does_not_follow_plans_nothing(tracking) -> None:
    for _ in range(20):
        tracking.tick()
    tracking.controller.stop('on request')
    stopped = tracking.tick()
    assert (stopped.mode, stopped.planned) == (Mode.STOPPING, None)
