"""The estimate of the model error, on motions whose error is known."""

import math

import numpy as np
import pytest
from push_core.geometry.frames import rotation
from push_mpc.estimate.disturbance import DisturbanceEstimator
from push_mpc.table.surrogate import Table

LENGTH = 0.02
MISSED = np.array([0.03, -0.05, 1.5])
STEP = 8e-4  # [m] of a tick at 80 mm/s


@pytest.fixture
def estimate(slider) -> DisturbanceEstimator:
    return DisturbanceEstimator(LENGTH, slider)


def pushed(estimate: DisturbanceEstimator, slider, table: Table, ticks: int, missed=MISSED):
    """Pushes an object that moves as the table says and a constant twist besides."""
    pose, p_y = np.array([0.2, -0.1, 0.7]), 0.004
    for _ in range(ticks):
        tip = slider.tip_position(pose, p_y)
        estimate.observe(table, pose, tip)
        direction = 1.4
        rate = np.array(table.rate(p_y, direction)) + missed
        turn = STEP * rate[2]
        middle = rotation(pose[2] + 0.5 * turn)
        moved = pose + np.array([*(middle @ (STEP * rate[:2])), turn])
        ahead = middle @ [math.sin(direction), math.cos(direction)]
        estimate.observe(table, moved, tip + STEP * ahead)
        # the next push begins elsewhere: no matter, but not a tick to learn from
        estimate._seen = None
        pose = moved
    return estimate.rate


def test_it_finds_a_constant_error(estimate, slider, table) -> None:
    found = pushed(estimate, slider, table, 400)
    assert found == pytest.approx(MISSED, rel=0.015)


def test_it_takes_its_length_of_travel_to_learn(estimate, slider, table) -> None:
    found = pushed(estimate, slider, table, round(LENGTH / STEP))
    assert found == pytest.approx((1.0 - math.exp(-1.0)) * MISSED, rel=0.03)


def test_a_length_of_zero_leaves_it_out(slider, table) -> None:
    assert not pushed(DisturbanceEstimator(0.0, slider), slider, table, 50).any()


@pytest.mark.parametrize('moved', [[0.03, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.3]])
def test_a_hand_that_moves_the_object_teaches_nothing(estimate, slider, table, moved) -> None:
    pose = np.zeros(3)
    tip = slider.tip_position(pose, 0.0)
    estimate.observe(table, pose, tip)
    estimate.observe(table, pose + moved, tip + np.array([STEP, 0.0]))
    assert not estimate.rate.any()


def test_a_tip_that_does_not_push_teaches_nothing(estimate, slider, table) -> None:
    pose = np.zeros(3)
    for gap, ahead in ((0.005, STEP), (0.0, -STEP), (0.0, 0.0)):
        tip = slider.tip_position(pose, 0.0, gap)
        estimate.reset()
        estimate.observe(table, pose, tip)
        moved = pose + np.array([1e-4, 0.0, 0.0])
        estimate.observe(table, moved, tip + np.array([ahead, 0.0]))
        assert not estimate.rate.any()


def test_it_stays_within_what_a_model_error_can_be(estimate, slider, table) -> None:
    absurd = np.array([-0.9, 0.9, 20.0])
    assert np.abs(pushed(estimate, slider, table, 400, absurd)).tolist() <= [0.4, 0.4, 12.0]
