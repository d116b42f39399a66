import math

import numpy as np
import pytest
from push_core.common.errors import InputError
from push_sim.plant.sensor import FREEZE_DURATION, Observation, Sensor
from push_sim.settings.plant_settings import SensorSettings

POSE, TIP = np.array([0.1, -0.2, 3.0]), np.array([0.05, -0.2])


def test_the_noise_has_the_stated_standard_deviation() -> None:
    settings = SensorSettings(position_noise=1e-4, angle_noise=2e-4)
    sensor = Sensor(settings)
    sensor.reset(np.random.default_rng(0))
    poses = [sensor.measured_pose(POSE) for _ in range(4000)]
    assert np.mean(poses, axis=0) == pytest.approx(POSE, abs=1e-5)
    assert np.std(poses, axis=0) == pytest.approx([1e-4, 1e-4, 2e-4], rel=0.05)


def test_the_noise_of_the_tip_has_the_stated_standard_deviation() -> None:
    sensor = Sensor(SensorSettings(tip_noise=2e-4))
    sensor.reset(np.random.default_rng(0))
    tips = [sensor.measured_tip(TIP) for _ in range(4000)]
    assert np.mean(tips, axis=0) == pytest.approx(TIP, abs=2e-5)
    assert np.std(tips, axis=0) == pytest.approx([2e-4, 2e-4], rel=0.05)


def test_each_bias_shifts_every_picture_by_itself() -> None:
    settings = SensorSettings(
        position_noise=0.0, angle_noise=0.0, angle_bias=0.02, tip_bias_x=1e-3, tip_bias_y=-2e-3
    )
    for picture in shown(settings, 5):
        assert picture.object_pose[2] == pytest.approx(POSE[2] + 0.02)
        np.testing.assert_allclose(picture.tip_position - TIP, [1e-3, -2e-3], atol=1e-12)
    assert np.array_equal(shown(settings, 5)[0].object_pose[:2], POSE[:2])


def test_a_sensor_without_noise_shows_the_truth() -> None:
    sensor = Sensor(SensorSettings(position_noise=0.0, angle_noise=0.0))
    sensor.expose(1.5, POSE, TIP)
    seen = sensor.show()
    assert seen.time == 1.5
    assert np.array_equal(seen.object_pose, POSE)
    assert np.array_equal(seen.tip_position, TIP)


@pytest.mark.parametrize(
    'trouble', [{'position_noise': 1e-3, 'angle_noise': 1e-2}, {'freeze_rate': 5.0}]
)
def test_the_truth_of_a_picture_is_the_pose_at_its_exposure(trouble: dict[str, float]) -> None:
    pictures = shown(SensorSettings(**trouble), 200)
    moved = POSE + np.outer(np.arange(200), [0.001, 0.0, 0.0])
    assert np.array_equal([picture.truth.object_pose for picture in pictures], moved)
    assert np.max(np.abs([picture.object_pose for picture in pictures] - moved)[:, 0]) > 1e-3


def test_the_heading_is_shown_between_minus_and_plus_half_a_turn() -> None:
    sensor = Sensor(SensorSettings(position_noise=0.0, angle_noise=0.0))
    assert sensor.measured_pose(np.array([0.0, 0.0, 4.0]))[2] == pytest.approx(4.0 - 2.0 * math.pi)


def test_pictures_are_shown_in_the_order_in_which_they_were_taken() -> None:
    sensor = Sensor(SensorSettings())
    for time in (0.0, 0.01, 0.02):
        sensor.expose(time, POSE, TIP)
    assert [sensor.show().time for _ in range(3)] == [0.0, 0.01, 0.02]


def shown(settings: SensorSettings, pictures: int, seed: int = 0) -> list[Observation | None]:
    """What is shown of an object that moves on by a millimetre a picture."""
    sensor = Sensor(settings)
    sensor.reset(np.random.default_rng(seed))
    sensor.expose(0.0, POSE, TIP)
    seen: list[Observation | None] = [sensor.show_first()]
    for number in range(1, pictures):
        sensor.expose(0.01 * number, POSE + np.array([0.001 * number, 0.0, 0.0]), TIP)
        seen.append(sensor.show())
    return seen


@pytest.mark.parametrize('dropout', [0.02, 0.5])
def test_pictures_get_lost_at_the_stated_rate_but_never_the_first(dropout: float) -> None:
    seen = shown(SensorSettings(dropout=dropout), 20_000)
    assert seen[0] is not None
    assert seen.count(None) / len(seen) == pytest.approx(dropout, rel=0.1)


def test_the_pose_stands_still_for_a_tenth_of_a_second_at_the_stated_rate() -> None:
    settings = SensorSettings(freeze_rate=0.5, position_noise=0.0)
    x = np.array([picture.object_pose[0] for picture in shown(settings, 50_000)])
    frozen = np.concatenate([[False], np.diff(x) == 0.0])
    begins = np.flatnonzero(frozen & ~np.roll(frozen, 1))
    ends = np.flatnonzero(frozen & ~np.roll(frozen, -1))
    # ten pictures show the same pose: nine of them that of the one before
    assert set((ends - begins + 1).tolist()) == {round(FREEZE_DURATION / 0.01) - 1}
    moving_time = 0.01 * (~frozen).sum()
    assert len(begins) / moving_time == pytest.approx(0.5, rel=0.15)


@pytest.mark.parametrize('rate', [100.0, 60.0, 30.0, 25.0])
def test_pictures_come_at_the_stated_rate(rate: float) -> None:
    settings = SensorSettings(rate=rate)
    sensor = Sensor(settings)
    sensor.reset(np.random.default_rng(0))
    for number in range(200):
        sensor.expose(0.01 * number, POSE, TIP)
    periods = [period for period in range(101) if sensor.show() is not None]
    assert len(periods) == round(rate) + 1
    assert np.diff(periods).min() == round(settings.shortest_interval / 0.01)
    # as soon as the period allows
    due = np.arange(len(periods)) / rate
    assert (np.round(0.01 * np.array(periods) - due, 9) >= 0.0).all()
    assert (0.01 * np.array(periods) - due < 0.01 - 1e-9).all()


def test_jitter_may_not_change_the_order_of_the_pictures() -> None:
    SensorSettings(rate=30.0, jitter=0.029)
    with pytest.raises(InputError, match=r'sensor.jitter is 0.03, must be less than .* 0.03 s'):
        SensorSettings(rate=30.0, jitter=0.03)
    with pytest.raises(InputError, match=r'sensor.jitter is 0.01, must be less than .* 0.01 s'):
        SensorSettings(jitter=0.01)


def test_a_frozen_pose_keeps_its_true_stamps() -> None:
    seen = shown(SensorSettings(freeze_rate=5.0), 200)
    assert [picture.time for picture in seen] == pytest.approx([0.01 * n for n in range(200)])


def test_each_trouble_draws_from_a_stream_of_its_own() -> None:
    quiet = shown(SensorSettings(), 500)
    troubled = shown(SensorSettings(dropout=0.2, tip_noise=1e-3), 500)
    for calm, seen in zip(quiet, troubled, strict=True):
        assert seen is None or np.array_equal(seen.object_pose, calm.object_pose)


def test_the_same_seed_gives_the_same_troubles() -> None:
    settings = SensorSettings(dropout=0.2, freeze_rate=1.0)
    lost = [[seen is None for seen in shown(settings, 300, seed)] for seed in (4, 4, 5)]
    assert lost[0] == lost[1] != lost[2]
