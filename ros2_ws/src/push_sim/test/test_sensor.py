import math

import numpy as np
import pytest
from push_sim.sensor import Sensor
from push_sim.settings import SensorSettings

POSE, TIP = np.array([0.1, -0.2, 3.0]), np.array([0.05, -0.2])


def test_the_noise_has_the_stated_standard_deviation() -> None:
    settings = SensorSettings(position_noise=1e-4, angle_noise=2e-4)
    sensor = Sensor(settings)
    sensor.reset(np.random.default_rng(0))
    poses = []
    for _ in range(4000):
        sensor.expose(0.0, POSE, TIP)
        poses.append(sensor.show(waiting=0).object_pose)
    assert np.mean(poses, axis=0) == pytest.approx(POSE, abs=1e-5)
    assert np.std(poses, axis=0) == pytest.approx([1e-4, 1e-4, 2e-4], rel=0.05)


def test_a_sensor_without_noise_shows_the_truth() -> None:
    sensor = Sensor(SensorSettings(position_noise=0.0, angle_noise=0.0))
    sensor.expose(1.5, POSE, TIP)
    seen = sensor.show(waiting=0)
    assert seen.time == 1.5
    assert np.array_equal(seen.object_pose, POSE)
    assert np.array_equal(seen.tip_position, TIP)


def test_the_heading_is_shown_between_minus_and_plus_half_a_turn() -> None:
    sensor = Sensor(SensorSettings(position_noise=0.0, angle_noise=0.0))
    sensor.expose(0.0, np.array([0.0, 0.0, 4.0]), TIP)
    assert sensor.show(waiting=0).object_pose[2] == pytest.approx(4.0 - 2.0 * math.pi)


def test_pictures_under_way_are_not_shown() -> None:
    sensor = Sensor(SensorSettings())
    for time in (0.0, 0.01, 0.02):
        sensor.expose(time, POSE, TIP)
    assert sensor.show(waiting=2).time == 0.0
    assert sensor.show(waiting=1).time == 0.01
