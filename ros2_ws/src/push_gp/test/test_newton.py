import numpy as np
import pytest
from push_gp.newton import stationary_point

LOW, HIGH = np.full(2, -5.0), np.full(2, 5.0)
MINIMUM = np.array([1.0, -2.0])


def gradient(at: np.ndarray) -> np.ndarray:
    """Of a bowl that is not a parabola."""
    return np.sinh(at - MINIMUM) + 0.3 * (at - MINIMUM)[::-1]


def test_it_finds_the_last_digits_from_wherever_the_search_stopped() -> None:
    for start in (MINIMUM + 0.01, np.array([0.98, -1.97])):
        found = stationary_point(gradient, start, LOW, HIGH)
        assert np.allclose(found, MINIMUM, rtol=0, atol=1e-13)


def test_what_lies_on_a_bound_stays_there() -> None:
    found = stationary_point(gradient, np.array([1.5, -2.14]), LOW, np.array([1.5, 5.0]))
    assert found[0] == 1.5
    assert abs(gradient(found)[1]) < 1e-12


@pytest.mark.parametrize('start', [[2.0, -1.0], [4.0, 4.0]])
def test_where_no_minimum_is_near_the_start_stays(start: list[float]) -> None:
    assert stationary_point(gradient, np.array(start), LOW, HIGH).tolist() == start
