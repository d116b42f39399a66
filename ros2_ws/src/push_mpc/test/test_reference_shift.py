"""What laps teach beside the table: the shift of the reference, and guesses of a plan."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.physics import Slider
from push_core.tracks import by_name
from push_mpc.plan import Lesson, ReferenceShift, guesses
from push_mpc.plan.nominal import flat_plan
from push_mpc.plan.reference_shift import GAIN, LARGEST

LAPS = 3


@pytest.fixture(scope='module')
def plan():
    return flat_plan(by_name('circle'), 0.08, Slider(), laps=LAPS, period=0.01, overrun=1.0)


def lap_times(plan, lap: int) -> np.ndarray:
    length = plan.duration / LAPS
    return np.arange(lap * length, (lap + 1) * length, plan.period)


def test_an_error_that_recurs_decays_from_lap_to_lap(plan):
    learner = ReferenceShift(plan, LAPS)
    times = lap_times(plan, 0)
    bump = 1e-3 * np.stack(
        [np.sin(2 * np.pi * times / times[-1]), np.cos(2 * np.pi * times / times[-1])], axis=-1
    )
    sizes = []
    for lap in range(5):
        rows = (lap_times(plan, 0) / (plan.duration / LAPS) * len(learner.shift)).astype(int)
        errors = bump + learner.shift[rows % len(learner.shift)]
        sizes.append(np.abs(errors).max())
        learner.learn(lap_times(plan, lap)[: len(errors)], errors)
    assert sizes[1] == pytest.approx((1.0 - GAIN) * sizes[0], rel=0.15)
    assert sizes[4] < 0.15 * sizes[0]


def test_what_was_not_measured_teaches_nothing(plan):
    learner = ReferenceShift(plan, LAPS)
    learner.learn(np.empty(0), np.empty((0, 2)))
    assert not learner.shift.any()
    times = lap_times(plan, 0)
    half = times < 0.5 * times[-1]
    learner.learn(times[half], np.full((int(half.sum()), 2), 1e-3))
    untaught = learner.shift[int(0.6 * len(learner.shift)) : int(0.9 * len(learner.shift))]
    assert not untaught.any()
    taught = learner.shift[int(0.1 * len(learner.shift)) : int(0.4 * len(learner.shift))]
    assert np.allclose(taught, -GAIN * 1e-3)


def test_the_shift_is_bounded(plan):
    learner = ReferenceShift(plan, LAPS)
    times = lap_times(plan, 1)
    learner.learn(times, np.full((len(times), 2), 1.0))
    assert np.abs(learner.shift).max() == pytest.approx(LARGEST)


def test_a_lesson_shifts_every_lap_alike(plan):
    count = len(lap_times(plan, 0))
    shift = np.stack([np.linspace(0.0, 1e-3, count), np.zeros(count)], axis=-1)
    moved = Lesson(shift=shift).reference(plan)
    change = moved.state - plan.state
    assert np.allclose(change[:count, :2], shift)
    assert np.allclose(change[count : 2 * count], change[:count])
    assert Lesson().reference(plan) is plan


def test_the_guess_for_another_support_radius_is_near_its_own_flat_plan(plan):
    known = replace(Slider(), support_radius=0.034)
    own = flat_plan(by_name('circle'), 0.08, known, laps=LAPS, period=0.01, overrun=1.0)
    leaning = [*guesses(plan, Slider(), known)]
    middle = slice(100, -200)
    squared = np.abs(leaning[1].state[middle, 2] - own.state[middle, 2]).max()
    unchanged = np.abs(plan.state[middle, 2] - own.state[middle, 2]).max()
    assert squared < 0.2 * unchanged
    assert leaning[-1] is plan
    assert [*guesses(plan, Slider(), Slider())] == [plan]
