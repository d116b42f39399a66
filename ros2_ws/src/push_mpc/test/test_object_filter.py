"""The filter of pose and model error, on motions that are known."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from push_core.geometry.frames import Array, rotation, wrap_angle
from push_core.physics.slider import Slider
from push_mpc.estimate.object_filter import ObjectFilter
from push_mpc.table.surrogate import Table

LENGTH = 0.05
MISSED = np.array([0.0, -0.05, 1.5])  # along the normal it would leave the tip
STEP = 8e-4  # [m] of a period at 80 mm/s
PERIOD = 0.01  # [s]
MOCAP = np.array([0.05e-3, 0.05e-3, math.radians(0.008)])
CAMERA = np.array([1e-3, 1e-3, math.radians(1.0)])
NONE = np.zeros(3)


class Push:
    """An object that moves as the table says, and by a twist besides, under a known tip."""

    def __init__(
        self, slider: Slider, table: Table, noise: Array, missed: Array = NONE, seed: int = 0
    ) -> None:
        self.pose = np.array([0.2, -0.1, 0.7])
        self.tip = slider.tip_position(self.pose, 0.004)
        self.time = 0.0
        self.filter = ObjectFilter(LENGTH, slider)
        self._slider, self._table, self._missed, self._noise = slider, table, missed, noise
        self._random = np.random.default_rng(seed)
        for _ in range(10):
            self.time += PERIOD
            self.filter.settle(self.seen(), self.tip, self.time)

    def seen(self) -> Array:
        return np.asarray(self.pose + self._noise * self._random.standard_normal(3))

    def move(self) -> None:
        """One period; the tip slides back to the middle of the face."""
        p_y = self._slider.contact_offset(self.pose, self.tip)
        direction = 0.5 * math.pi + float(np.clip(100.0 * p_y, -1.2, 1.2))
        rate = np.array(self._table.rate(p_y, direction)) + self._missed
        turn = STEP * rate[2]
        middle = rotation(self.pose[2] + 0.5 * turn)
        self.tip = self.tip + STEP * (middle @ [math.sin(direction), math.cos(direction)])
        self.pose = self.pose + np.array([*(middle @ (STEP * rate[:2])), turn])
        self.time += PERIOD

    def observe(self, pose: Array | None = None) -> Array:
        """Shows the filter this pose, or a measured one; its error (3,)."""
        seen = self.seen() if pose is None else pose
        self.filter.observe(self._table, seen, self.tip, self.time)
        error = self.filter.pose - self.pose
        error[2] = wrap_angle(error[2])
        return np.asarray(error)

    def errors(self, poses: int, every: int = 1) -> Array:
        """Errors (poses, 3) of as many poses, one every so many periods."""
        found = []
        for _ in range(poses):
            for _ in range(every):
                self.move()
            found.append(self.observe())
        return np.array(found)


def rms(errors: Array) -> Array:
    return np.sqrt(np.mean(errors**2, axis=0))


@pytest.fixture
def push(slider, table):
    """Makes an object under a camera with this noise."""
    return lambda noise, missed=NONE, seed=0: Push(slider, table, noise, missed, seed)


def test_it_finds_a_constant_model_error(push) -> None:
    known = push(MOCAP, MISSED)
    known.errors(300)
    assert known.filter.rate == pytest.approx(MISSED, rel=0.08, abs=4e-3)


def test_a_good_camera_shows_the_model_error_after_its_length_of_travel(push) -> None:
    known = push(0.02 * MOCAP, MISSED)
    known.errors(round(LENGTH / STEP))
    assert known.filter.rate == pytest.approx((1.0 - math.exp(-1.0)) * MISSED, rel=0.08, abs=2e-3)


def test_a_length_of_zero_leaves_the_model_error_out(push) -> None:
    known = push(MOCAP, MISSED)
    known.errors(50)
    known.filter.change(0.0)
    known.errors(50)
    assert not known.filter.rate.any()


@pytest.mark.parametrize('noise', [0.5 * CAMERA, CAMERA])
def test_of_a_bad_camera_a_quarter_of_the_noise_is_left(push, noise) -> None:
    errors = push(noise).errors(600)[50:]
    assert (rms(errors) < 0.25 * noise).all()


def test_it_is_never_worse_than_a_good_camera(push) -> None:
    errors = push(MOCAP, MISSED).errors(600)
    assert (rms(errors) < 1.05 * MOCAP).all()


@pytest.mark.parametrize('every', [3, 5])
def test_it_follows_a_camera_with_few_pictures(push, every) -> None:
    errors = push(CAMERA).errors(250, every)[30:]
    assert (rms(errors) < 0.4 * CAMERA).all()


@pytest.mark.parametrize('noise', [MOCAP, CAMERA, 3.0 * CAMERA])
def test_it_measures_the_noise_of_the_camera(push, noise) -> None:
    known = push(noise)
    known.errors(600)
    measured = np.sqrt(known.filter.camera_variance)
    assert measured == pytest.approx(noise, rel=0.2)


@pytest.mark.parametrize('noise', [MOCAP, CAMERA])
def test_its_intervals_hold_what_they_say(push, noise) -> None:
    inside = []
    for seed in range(4):
        known = push(noise, seed=seed)
        for _ in range(300):
            known.errors(1)
            inside.append(np.abs(known.filter.innovation) < 1.96 * known.filter.deviation)
    assert (np.mean(inside, axis=0) >= 0.92).all()


def test_a_model_that_is_wrong_does_not_make_it_overconfident(push) -> None:
    """Pose errors stay those of the camera while the model error is learnt and after it."""
    errors = push(CAMERA, 2.0 * MISSED).errors(400)
    assert (rms(errors) < 0.9 * CAMERA).all()
    assert (np.abs(errors) < 3.0 * CAMERA).all()


@pytest.mark.parametrize('noise', [MOCAP, CAMERA])
def test_one_outlier_is_left_out(push, noise) -> None:
    known = push(noise)
    known.errors(60)
    rate = known.filter.rate
    known.move()
    error = known.observe(known.pose + np.array([0.05, -0.03, 0.4]))
    assert (np.abs(error) < 3.0 * noise).all()
    assert np.array_equal(known.filter.rate, rate)
    assert (np.abs(known.errors(1)) < 3.0 * noise).all()


@pytest.mark.parametrize('noise', [MOCAP, CAMERA])
@pytest.mark.parametrize('moved', [[0.03, 0.0, 0.0], [0.0, 0.03, 0.0], [0.0, 0.0, 0.5]])
def test_it_finds_an_object_moved_by_hand_in_the_second_picture(push, noise, moved) -> None:
    known = push(noise)
    known.errors(60)
    rate = known.filter.rate
    known.pose = known.pose + moved
    known.observe()
    assert (np.abs(known.observe()) < 4.0 * noise).all()
    assert np.array_equal(known.filter.rate, rate)


def test_a_jump_does_not_make_it_follow_the_noise_of_the_camera(push) -> None:
    known = push(CAMERA)
    known.errors(100)
    known.pose = known.pose + np.array([0.03, 0.0, 0.3])
    known.observe()
    errors = known.errors(60)[30:]
    assert (rms(errors) < 0.5 * CAMERA).all()


def test_an_object_that_slides_away_after_a_kick_is_followed(push) -> None:
    known = push(MOCAP)
    known.errors(60)
    for _ in range(20):
        known.pose = known.pose + np.array([0.003, 0.001, 0.02])
        known.time += PERIOD
        error = known.observe()
    assert (np.abs(error) < 4.0 * MOCAP).all()


def test_a_tip_that_does_not_push_teaches_nothing(push, slider) -> None:
    known = push(MOCAP)
    for gap in (0.005, 0.006, 0.0045, 0.008):
        known.tip = slider.tip_position(known.pose, 0.0, gap)
        known.time += PERIOD
        known.observe()
    assert np.abs(known.filter.rate).max() < 1e-9


def test_a_tip_that_is_placed_elsewhere_does_not_push(push, slider) -> None:
    known = push(MOCAP)
    known.errors(60)
    known.tip = known.tip + rotation(known.pose[2]) @ np.array([1e-4, 0.02])
    known.time += PERIOD
    assert (np.abs(known.observe()) < 3.0 * MOCAP).all()


def test_the_model_error_stays_within_what_one_can_be(push) -> None:
    known = push(MOCAP, np.array([-0.9, 0.9, 20.0]))
    known.errors(100)
    assert (np.abs(known.filter.rate) <= [0.4, 0.4, 12.0]).all()


def test_a_new_start_forgets_everything(push, slider) -> None:
    known = push(CAMERA, MISSED)
    known.errors(100)
    known.filter.reset()
    assert not known.filter.rate.any()
    fresh = ObjectFilter(LENGTH, slider)
    assert np.array_equal(known.filter.camera_variance, fresh.camera_variance)
    assert np.array_equal(known.filter._covariance, fresh._covariance)


POSES = st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0), st.floats(-7.0, 7.0)).map(np.array)
TIPS = st.tuples(st.floats(-5.0, 5.0), st.floats(-5.0, 5.0)).map(np.array)
SIGHTINGS = st.tuples(
    st.sampled_from(['seen', 'anything', 'again']), POSES, TIPS, st.sampled_from([0.0, 0.01, 0.2])
)


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(SIGHTINGS, max_size=15))
def test_whatever_it_sees_it_stays_finite_and_finds_the_object_again(push, sightings) -> None:
    known = push(MOCAP)
    for kind, pose, tip, later in sightings:
        known.time += later
        known.move()
        if kind == 'anything':
            known.filter.observe(known._table, pose, tip, known.time)
        else:
            known.observe(known.filter.pose if kind == 'again' else None)
        assert np.isfinite(known.filter.pose).all()
        assert (known.filter.deviation > 0.0).all()
        assert (np.abs(known.filter.rate) <= [0.4, 0.4, 12.0]).all()
    errors = known.errors(4)
    assert (np.abs(errors[-1]) < 5e-3 + 5.0 * np.sqrt(known.filter.camera_variance)).all()
