"""What laps have taught, as the controller uses it: a shifted reference, guesses of a plan."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.geometry import rotation
from push_core.physics import Slider
from push_core.tracks import by_name
from push_mpc.plan import Lesson
from push_mpc.plan.leaning import guesses
from push_mpc.plan.nominal import flat_plan

LAPS = 3


@pytest.fixture(scope='module')
def plan():
    return flat_plan(by_name('circle'), 0.08, Slider(), laps=LAPS, period=0.01, overrun=1.0)


def lap_times(plan, lap: int) -> np.ndarray:
    length = plan.duration / LAPS
    return np.arange(lap * length, (lap + 1) * length, plan.period)


def test_a_lesson_shifts_every_lap_alike(plan):
    count = len(lap_times(plan, 0))
    shift = np.stack([np.linspace(0.0, 1e-3, count), np.zeros(count)], axis=-1)
    moved = Lesson(shift=shift).reference(plan)
    change = moved.state - plan.state
    assert np.allclose(change[:count, :2], shift @ rotation(plan.state[0, 2]).T)
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
