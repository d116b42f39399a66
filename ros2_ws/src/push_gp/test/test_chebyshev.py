import numpy as np
import pytest
from push_gp.low_rank.chebyshev import HALF_WIDTH, INTERVALS, Interval, covers


def test_coefficients_reproduce_the_function_between_the_nodes() -> None:
    interval = Interval(0.3, 2.0)
    coefficients = interval.transform(30) @ np.exp(np.sin(interval.nodes(30)))
    points = np.linspace(-1.7, 2.3, 101)
    values = interval.polynomials(points, 30) @ coefficients
    assert np.abs(values - np.exp(np.sin(points))).max() < 1e-9


@pytest.mark.parametrize('lengthscale', [3.0, 0.2])
def test_enough_polynomials_give_the_kernel_and_its_slope_to_round_off(lengthscale: float) -> None:
    interval = INTERVALS[1]
    count = interval.enough(lengthscale)
    points = np.linspace(0.01, 3.1, 40)
    values = interval.polynomials(points, count)
    kernel, slope = (values @ part @ values.T for part in interval.kernel(lengthscale, count))
    exponent = ((points[:, None] - points) / lengthscale) ** 2
    assert np.abs(kernel - np.exp(-exponent)).max() < 1e-13
    assert np.abs(slope - 2.0 * exponent * np.exp(-exponent)).max() < 1e-12


def test_an_interval_around_points_holds_them_and_has_a_width() -> None:
    assert Interval.around(np.array([1.0, 3.0, 2.0])) == Interval(2.0, 1.0)
    assert Interval.around(np.array([0.5])).half_width > 0.0


def test_the_domain_ends_beyond_the_face() -> None:
    edge = np.array([[HALF_WIDTH[0], 1.5]])
    assert covers(0.999 * edge + [0.0, 0.001])
    assert not covers(1.01 * edge)
