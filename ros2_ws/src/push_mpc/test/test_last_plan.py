import numpy as np
import pytest
from push_mpc.qp.last_plan import LastPlan

STRIDE = 5


@pytest.fixture
def last() -> LastPlan:
    """A plan whose deviations grow evenly, at the horizon that begins at sample 100."""
    made = LastPlan(steps=4, inputs=2)
    made.shift(100, STRIDE)
    made.keep(np.tile(np.arange(5.0), (4, 1)).T, np.tile(10.0 * np.arange(4.0), (2, 1)).T)
    return made


@pytest.mark.parametrize(
    ('sample', 'states', 'inputs'),
    [
        (100, [0, 1, 2, 3, 4], [0, 10, 20, 30]),
        (101, [0.2, 1.2, 2.2, 3.2, 4], [2, 12, 22, 30]),
        (105, [1, 2, 3, 4, 4], [10, 20, 30, 30]),
        (108, [1.6, 2.6, 3.6, 4, 4], [16, 26, 30, 30]),
        (98, [0, 1, 2, 3, 4], [0, 10, 20, 30]),
        (119, [3.8, 4, 4, 4, 4], [30, 30, 30, 30]),
    ],
)
def test_it_is_shifted_by_interpolation_and_its_end_stays(last, sample, states, inputs) -> None:
    last.shift(sample, STRIDE)
    assert last.states == pytest.approx(np.tile(states, (4, 1)).T)
    assert last.inputs == pytest.approx(np.tile(inputs, (2, 1)).T)


@pytest.mark.parametrize('sample', [95, 120, 0])
def test_a_horizon_that_does_not_begin_within_it_is_on_the_nominal(last, sample) -> None:
    last.shift(sample, STRIDE)
    assert not last.states.any()
    assert not last.inputs.any()


def test_shifting_twice_is_shifting_once(last) -> None:
    last.shift(103, STRIDE)
    last.shift(102, STRIDE)
    assert last.states[:, 0] == pytest.approx([0.4, 1.4, 2.4, 3.4, 4.0])


def test_a_plan_that_was_forgotten_is_the_nominal(last) -> None:
    last.forget()
    last.shift(101, STRIDE)
    assert not last.states.any()
    assert not last.inputs.any()
