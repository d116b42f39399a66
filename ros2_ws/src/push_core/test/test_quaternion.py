import math

import numpy as np
import pytest
from push_core.geometry.quaternion import grid_yaw, quaternion_to_yaw, yaw_to_quaternion

YAWS = np.random.default_rng(0).uniform(-10.0, 10.0, 20000).tolist()


def test_a_yaw_on_the_grid_survives_the_trip_to_the_last_bit() -> None:
    for yaw in (*YAWS, math.pi, -math.pi, 0.0):
        kept = grid_yaw(yaw)
        _, _, z, w = yaw_to_quaternion(kept)
        assert quaternion_to_yaw(z, w) == kept


def test_the_grid_moves_no_angle_by_more_than_half_a_step() -> None:
    for yaw in YAWS:
        assert abs(math.remainder(grid_yaw(yaw) - yaw, math.tau)) <= 2.0**-40


def test_both_signs_of_a_quaternion_are_the_same_yaw() -> None:
    _, _, z, w = yaw_to_quaternion(2.5)
    assert quaternion_to_yaw(-z, -w) == quaternion_to_yaw(z, w) == pytest.approx(2.5)


def test_a_quarter_turn_has_the_textbook_quaternion() -> None:
    half = math.sqrt(0.5)
    assert yaw_to_quaternion(math.pi / 2.0) == pytest.approx((0.0, 0.0, half, half))
