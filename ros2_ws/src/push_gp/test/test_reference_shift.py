"""The shift of the reference against errors that recur."""

import math

import numpy as np
import pytest
from push_gp.learn import ReferenceShift, TimedReference
from push_gp.learn.reference_shift import FASTEST, GAIN, LARGEST, WANDERED
from push_gp.learn.smoothing import PoseNoise

LAPS = 3


@pytest.fixture(scope='module')
def reference():
    """A circle of radius 0.15 m at 80 mm/s."""
    lap_time = 2.0 * math.pi * 0.15 / 0.08
    time = np.append(np.arange(0.0, LAPS * lap_time, 0.01), LAPS * lap_time)
    angle = 2.0 * math.pi * time / lap_time
    position = 0.15 * np.column_stack((np.sin(angle), 1.0 - np.cos(angle)))
    return TimedReference('circle', 0.08, LAPS, time, position, 0.3)


def lap_times(reference, lap: int) -> np.ndarray:
    return np.arange(lap * reference.lap_time, (lap + 1) * reference.lap_time, reference.period)


def test_an_error_that_recurs_decays_from_lap_to_lap(reference):
    learner = ReferenceShift(reference)
    times = lap_times(reference, 0)
    bump = 1e-3 * np.stack(
        [np.sin(2 * np.pi * times / times[-1]), np.cos(2 * np.pi * times / times[-1])], axis=-1
    )
    sizes = []
    for lap in range(5):
        rows = (lap_times(reference, 0) / (reference.lap_time) * len(learner.shift)).astype(int)
        errors = bump + learner.shift[rows % len(learner.shift)]
        sizes.append(np.abs(errors).max())
        learner.learn(lap_times(reference, lap)[: len(errors)], errors)
    assert sizes[1] == pytest.approx((1.0 - GAIN) * sizes[0], rel=0.15)
    assert sizes[4] < 0.15 * sizes[0]


def test_what_was_not_measured_teaches_nothing(reference):
    learner = ReferenceShift(reference)
    learner.learn(np.empty(0), np.empty((0, 2)))
    assert not learner.shift.any()
    times = lap_times(reference, 0)
    half = times < 0.5 * times[-1]
    learner.learn(times[half], np.full((int(half.sum()), 2), 1e-3))
    untaught = learner.shift[int(0.6 * len(learner.shift)) : int(0.9 * len(learner.shift))]
    assert not untaught.any()
    taught = learner.shift[int(0.1 * len(learner.shift)) : int(0.4 * len(learner.shift))]
    assert np.allclose(taught, -GAIN * 1e-3)


def test_what_noise_explains_does_not_shift_the_reference(reference):
    learner, random = ReferenceShift(reference), np.random.default_rng(0)
    noise = PoseNoise(1e-3, 0.02, 2.7e-3)
    white = random.normal(0.0, 1e-3, (2000, 2))
    size = noise.position * math.sqrt(noise.spacing / WANDERED)
    wander = np.tile(random.normal(0.0, size, (50, 1, 2)), (1, 40, 1)).reshape(-1, 2)
    learner.trust(white + wander, noise)
    assert learner.gain < 0.3 * GAIN
    learner.trust(white + wander + [5e-3, 0.0], noise)
    assert learner.gain > 0.9 * GAIN
    learner.trust(white, noise)
    learner.learn(lap_times(reference, 0)[:1000], white[:1000])
    assert not learner.shift.any()
    learner.trust(white, PoseNoise())
    assert learner.gain == GAIN
    learner.trust(np.empty((0, 2)), noise)
    assert learner.gain == 0.0


def test_the_shift_is_bounded(reference):
    learner = ReferenceShift(reference)
    times = lap_times(reference, 1)
    for _ in range(20):
        learner.learn(times, np.full((len(times), 2), 1.0))
    assert np.abs(learner.shift).max() == pytest.approx(LARGEST)


def test_a_large_error_shifts_the_reference_in_small_steps_along_itself(reference):
    learner = ReferenceShift(reference)
    times = lap_times(reference, 1)
    error = np.array([0.012, -0.016])
    learner.learn(times, np.tile(error, (len(times), 1)))
    np.testing.assert_allclose(
        learner.shift, np.tile(-FASTEST * error / 0.02, (len(learner.shift), 1))
    )


def test_errors_are_those_in_the_frame_of_the_start(reference):
    times = np.array([1.234, 40.0])
    wanted = np.column_stack([np.interp(times, reference.time, c) for c in reference.position.T])
    ahead = np.array([math.cos(0.3), math.sin(0.3)])
    errors = reference.errors(times, wanted + 1e-3 * ahead)
    np.testing.assert_allclose(errors, [[1e-3, 0.0]] * 2, atol=1e-12)
