import math

import numpy as np
import pytest
from push_mpc.motion.dynamics import linearised, rates

TIP_X = -0.05
STATE = np.array([0.3, -0.2, 0.7, 0.012])
INPUT = np.array([0.06, 0.03])


class Constant:
    """A model that answers the same to everything."""

    def __init__(self, *rate: float) -> None:
        self._rate = np.array(rate)

    def evaluate(self, p_y, beta):
        return np.tile(self._rate, (len(p_y), 1)), np.zeros((len(p_y), 3, 2))


@pytest.fixture(scope='module')
def cases():
    generator = np.random.default_rng(1)
    state = generator.uniform([-1, -1, -4, -0.04], [1, 1, 4, 0.04], (50, 4))
    inputs = generator.uniform([0.01, -0.1], [0.2, 0.1], (50, 2))
    return state, inputs


def test_the_rates_are_those_worked_out_by_hand() -> None:
    # an object that looks along +y, pushed at 0.05 m/s: 0.8 of it forwards, 0.1 left, 6 rad/m
    state, inputs = np.array([[0.0, 0.0, math.pi / 2, 0.0]]), np.array([[0.04, 0.03]])
    found = rates(Constant(0.8, 0.1, 6.0), state, inputs, TIP_X)[0]
    p_y_rate = 0.03 - (0.05 * 0.1 + 0.05 * 6.0 * TIP_X)
    assert found == pytest.approx([-0.005, 0.04, 0.3, p_y_rate])


def test_twice_the_speed_is_twice_the_rate(model, cases) -> None:
    state, inputs = cases
    once, twice = (rates(model, state, factor * inputs, TIP_X) for factor in (1.0, 2.0))
    assert np.allclose(twice, 2.0 * once, rtol=1e-12)


def test_the_world_frame_turns_with_the_object(model) -> None:
    turned = STATE + np.array([0.0, 0.0, math.pi / 2, 0.0])
    x, y, turn, slip = rates(model, STATE[None], INPUT[None], TIP_X)[0]
    assert rates(model, turned[None], INPUT[None], TIP_X)[0] == pytest.approx([-y, x, turn, slip])


def test_the_linearisation_is_that_of_central_differences(
    model, cases, central_differences
) -> None:
    by_state, by_input = linearised(model, *cases, TIP_X)
    scale = np.array([1.0, 1.0, 1.0, 0.03, 0.05, 0.05])

    def rates_at(point):
        values = point * scale
        return rates(model, values[None, :4], values[None, 4:], TIP_X)[0]

    for state, inputs, a, b in zip(*cases, by_state, by_input, strict=True):
        point = np.concatenate([state, inputs]) / scale
        expected = central_differences(rates_at, point, 1e-5)
        found = np.hstack([a, b]) * scale
        assert np.allclose(found, expected, rtol=0, atol=1e-6 * np.abs(expected).max())


def test_no_push_at_all_gives_no_motion_and_no_fault(model) -> None:
    state, still = STATE[None], np.zeros((1, 2))
    assert np.allclose(rates(model, state, still, TIP_X), 0.0, atol=1e-8)
    assert all(np.isfinite(part).all() for part in linearised(model, state, still, TIP_X))
