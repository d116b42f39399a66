import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from push_core.common.errors import InputError
from push_mpc.table.surrogate import Grid, Table

P_Y = st.floats(-0.07, 0.07)
BETA = st.floats(-0.5, 3.6)


@pytest.fixture(scope='module')
def smooth(model, tabulated) -> Table:
    return tabulated(model)


@pytest.fixture(scope='module')
def inside():
    generator = np.random.default_rng(1)
    return generator.uniform(-0.044, 0.044, 300), generator.uniform(0.16, 2.98, 300)


def test_at_the_grid_points_the_table_is_the_model_itself(model, tabulated) -> None:
    grid = Grid(np.linspace(-0.045, 0.045, 7), np.linspace(0.3, 2.8, 9))
    mean, jacobian = model.evaluate(*grid.points())
    found, slope = Table(grid, mean, jacobian).evaluate(*grid.points())
    assert np.allclose(found, mean, rtol=0, atol=1e-13)
    assert np.allclose(slope, jacobian, rtol=0, atol=1e-11)


def test_the_jacobian_is_that_of_central_differences(smooth, inside, central_differences) -> None:
    _, jacobian = smooth.evaluate(*inside)
    scale = np.array([0.03, 1.0])

    def mean_at(point):
        return smooth.evaluate(*(point * scale)[:, None])[0][0]

    for point, found in zip(np.stack(inside, axis=-1), jacobian, strict=True):
        expected = central_differences(mean_at, point / scale, 1e-5)
        assert np.allclose(found * scale, expected, rtol=0, atol=1e-6 * np.abs(expected).max())


@pytest.mark.parametrize('points', [10, 20])
def test_a_grid_twice_as_fine_is_sixteen_times_as_exact(model, tabulated, inside, points) -> None:
    def largest_error(cells: int) -> float:
        table = tabulated(model, cells + 1, cells + 1)
        middle = np.abs(inside[0]) < 0.03, np.abs(inside[1] - 1.57) < 1.0
        kept = middle[0] & middle[1]
        p_y, beta = inside[0][kept], inside[1][kept]
        return np.abs(table.evaluate(p_y, beta)[0] - model.evaluate(p_y, beta)[0]).max()

    assert largest_error(points) / largest_error(2 * points) == pytest.approx(16.0, rel=0.35)


@given(P_Y, BETA)
def test_one_point_is_answered_as_in_a_batch(p_y, beta) -> None:
    table = one_table()
    batch, _ = table.evaluate(np.array([p_y]), np.array([beta]))
    assert np.allclose(table.rate(p_y, beta), batch[0], rtol=1e-12, atol=1e-12)


def one_table() -> Table:
    grid = Grid(np.linspace(-0.045, 0.045, 5), np.linspace(0.15, 3.0, 6))
    generator = np.random.default_rng(2)
    return Table(grid, generator.normal(size=(30, 3)), generator.normal(size=(30, 3, 2)))


def test_outside_the_grid_the_answer_is_that_of_its_edge_and_flat_across_it() -> None:
    table = one_table()
    beyond, slope = table.evaluate(np.array([0.06, 0.01]), np.array([1.0, 3.1]))
    edge, along = table.evaluate(np.array([0.045, 0.01]), np.array([1.0, 3.0]))
    assert np.allclose(beyond, edge, rtol=0, atol=1e-13)
    assert not slope[0, :, 0].any()
    assert not slope[1, :, 1].any()
    assert np.allclose(slope[0, :, 1], along[0, :, 1], rtol=0, atol=1e-12)


@pytest.mark.parametrize('bad', [np.nan, np.inf])
def test_answers_that_are_not_finite_make_no_table(model, bad) -> None:
    grid = Grid(np.linspace(-0.045, 0.045, 3), np.linspace(0.3, 2.8, 3))
    mean, jacobian = model.evaluate(*grid.points())
    jacobian[4, 1, 0] = bad
    with pytest.raises(InputError, match='not finite'):
        Table(grid, mean, jacobian)
