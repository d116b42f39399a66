"""The noise of the camera, measured in the poses of a push, and smoothed away."""

import math

import numpy as np
import pytest
from push_gp.learn.smoothing import (
    ACCURACY,
    FEWEST_POSES,
    PoseNoise,
    pose_noise,
    smoothed_at,
)

POSITION, ANGLE, STEP = 5e-4, 0.01, 8e-4


def noisy_bend(samples: int = 2000, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Poses (m, 3) with noise and tips (m, 2) of a push along a circle of radius 0.15 m."""
    angle = STEP * np.arange(samples) / 0.15
    centre = 0.15 * np.column_stack((np.sin(angle), 1.0 - np.cos(angle)))
    noise = np.random.default_rng(seed).normal(size=(samples, 3))
    poses = np.column_stack((centre, angle)) + noise * [POSITION, POSITION, ANGLE]
    return poses, centre - 0.05 * np.column_stack((np.cos(angle), np.sin(angle)))


@pytest.mark.parametrize('lost', [0.0, 0.5])
def test_noise_is_measured_also_where_pictures_are_lost(lost):
    poses, tips = noisy_bend()
    seen = np.random.default_rng(1).random(len(poses)) >= lost
    found = pose_noise(poses[seen], tips[seen])
    assert found.position == pytest.approx(POSITION, rel=0.1)
    assert found.angle == pytest.approx(ANGLE, rel=0.1)


def test_a_camera_without_noise_has_none_and_a_jump_is_no_noise():
    poses, tips = noisy_bend()
    angle = STEP * np.arange(len(poses)) / 0.15
    exact = np.column_stack((0.15 * np.sin(angle), 0.15 * (1.0 - np.cos(angle)), angle))
    exact[1000:] += [0.03, 0.0, 0.2]
    assert pose_noise(exact, tips).position < 5e-6
    assert pose_noise(exact[: FEWEST_POSES - 1], tips) == PoseNoise()


def test_poses_of_a_good_camera_are_not_smoothed():
    assert PoseNoise(5e-5, 1.4e-4, STEP).width(4e-3) == 0.0
    marks, travel = np.array([0.1, 0.25]), np.arange(10.0) / 20.0
    values = np.random.default_rng(0).normal(size=(10, 3))
    expected = np.column_stack([np.interp(marks, travel, column) for column in values.T])
    assert np.array_equal(smoothed_at(marks, travel, values, 0.0), expected)


def test_a_line_is_not_changed_by_smoothing():
    travel = np.sort(np.random.default_rng(0).random(200))
    values = np.column_stack((2.0 * travel, 1.0 - travel))
    marks = np.linspace(0.0, 1.0, 20)
    found = smoothed_at(marks, travel, values, 0.05)
    assert np.allclose(found, np.column_stack((2.0 * marks, 1.0 - marks)))


def test_smoothing_leaves_in_a_push_what_the_width_is_for():
    noise, distance = PoseNoise(POSITION, 0.0, STEP), 4e-3
    poses, _ = noisy_bend(20000)
    travel, marks = STEP * np.arange(20000), np.arange(1.0, 15.0, distance)
    found = smoothed_at(marks, travel, poses - noisy_bend(20000, 1)[0], noise.width(distance))
    moved = np.diff(found[:, 0]) / math.sqrt(2.0)  # the difference of two noises
    assert 0.5 * ACCURACY * distance < np.std(moved) < ACCURACY * distance


def test_whatever_the_travel_is_smoothing_is_finite():
    values = np.arange(20.0).reshape(-1, 1)
    assert np.isfinite(smoothed_at(np.zeros(3), np.zeros(20), values, 0.01)).all()
