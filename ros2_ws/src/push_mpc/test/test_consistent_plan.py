"""The plan that a model believes in, held to that model's motion equations."""

from dataclasses import replace

import numpy as np
import pytest
from push_core.physics.motion_cone import MotionCone
from push_core.tracks.built_in import by_name
from push_mpc.motion.dynamics import TravelMotion
from push_mpc.plan.consistent_plan import consistent_plan
from push_mpc.plan.nominal import flat_plan
from scipy.interpolate import CubicSpline

SPEED = 0.08


@pytest.fixture(scope='module')
def motion(slider, tabulated) -> TravelMotion:
    # so coarse a table rounds the edges of the friction cone off, as a learned model does
    table = tabulated(MotionCone(replace(slider, friction_pusher=0.3)), 9, 9)
    return TravelMotion(table, slider.tip_x)


@pytest.fixture(scope='module')
def flat(slider):
    return flat_plan(by_name('circle'), SPEED, slider, laps=1, period=0.0125, overrun=1.0)


@pytest.fixture(scope='module')
def plan(flat, motion):
    return consistent_plan(flat, motion)


def missed(plan, motion) -> np.ndarray:
    """How far the motion equations lead away from the plan over each second of it (n, 4)."""
    rates = CubicSpline(plan.time, motion.rates(plan.state, plan.input)).antiderivative()
    second = round(1.0 / plan.period)
    integral = rates(plan.time[second:]) - rates(plan.time[:-second])
    return plan.state[second:] - plan.state[:-second] - integral


def test_it_keeps_to_the_motion_equations_that_the_flat_plan_leaves(flat, plan, motion) -> None:
    assert np.abs(missed(flat, motion)[:, 3]).max() > 1e-3
    assert np.abs(missed(plan, motion)).max() < 1e-3


def test_it_starts_where_the_flat_plan_starts_and_follows_its_path(flat, plan) -> None:
    assert plan.state[0] == pytest.approx(flat.state[0], abs=1e-9)
    off = np.hypot(*(plan.state - flat.state)[:, :2].T)
    assert off.max() < 2e-3
    assert off.mean() < 1e-4


def test_the_contact_stays_near_the_middle_of_the_face(plan) -> None:
    assert np.abs(plan.state[:, 3]).max() < 0.03


def test_a_model_that_makes_no_sense_leaves_the_plan_as_it_is(flat, slider) -> None:
    class Nonsense:
        def evaluate(self, p_y, beta):
            return np.full((len(p_y), 3), np.nan), np.full((len(p_y), 3, 2), np.nan)

    assert consistent_plan(flat, TravelMotion(Nonsense(), slider.tip_x)) is None


def test_a_plan_that_slides_a_lot_is_not_taken(flat, plan, motion) -> None:
    asked = np.abs(plan.input - flat.input).max() / SPEED
    assert consistent_plan(flat, motion, largest_change=0.8 * asked) is None
