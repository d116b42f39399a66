import numpy as np
import pytest
from push_core.data.push_set import P_Y_LIMIT
from push_gp.models.batched_mean import BatchedMean
from push_gp.models.mean_function import ZeroMean
from push_gp.models.polynomial_mean import summed_up
from push_gp.models.polynomials import QUERIES_AT_ONCE, Polynomials, added
from push_gp.models.posterior_mean import PosteriorMean
from push_gp.regression.gp import GaussianProcess
from push_gp.regression.hyperparameters import Hyperparameters

LONG, SHORT = (0.02, 0.7), (0.003, 0.2)
CORNERS = np.array([[y, beta] for y in (-P_Y_LIMIT, P_Y_LIMIT) for beta in (1e-9, np.pi - 1e-9)])


def processes(
    count: int, *lengthscales: tuple[float, float], noise: float = 0.1
) -> list[GaussianProcess]:
    generator = np.random.default_rng(4)
    inputs = generator.uniform([-0.045, 0.1], [0.045, 3.0], (count, 2))
    return [
        GaussianProcess(inputs, generator.normal(size=count), Hyperparameters(lengths, 1.0, noise))
        for lengths in lengthscales
    ]


def polynomials(gps: list[GaussianProcess]) -> Polynomials:
    return Polynomials(summed_up(gps))


@pytest.mark.parametrize('noise', [0.1, 0.01])
@pytest.mark.parametrize('lengthscales', [[LONG, (0.05, 2.0)], [SHORT]])
def test_polynomials_give_the_mean_and_jacobian_of_the_pushes(
    lengthscales: list[tuple[float, float]], noise: float
) -> None:
    gps = processes(300, *lengthscales, noise=noise)
    queries = np.vstack((gps[0].inputs[:50], CORNERS))
    mean, jacobian = polynomials(gps).evaluate(queries)
    true_mean, true_jacobian = BatchedMean(gps).evaluate(queries)
    assert np.abs(mean - true_mean).max() < 1e-10 * np.abs(true_mean).max()
    assert np.abs(jacobian - true_jacobian).max() < 1e-9 * np.abs(true_jacobian).max()


def test_no_more_polynomials_are_kept_than_the_mean_needs() -> None:
    assert polynomials(processes(50, (0.1, 5.0))).size < 300
    assert polynomials(processes(50, LONG)).size < polynomials(processes(50, SHORT)).size


def test_a_batch_of_any_length_answers_alike() -> None:
    mean = polynomials(processes(20, LONG, (0.05, 2.0)))
    queries = np.random.default_rng(5).uniform([-0.045, 0.1], [0.045, 3.0], (1500, 2))
    assert len(queries) > QUERIES_AT_ONCE
    for whole, last in zip(mean.evaluate(queries), mean.evaluate(queries[-9:]), strict=True):
        assert np.allclose(whole[-9:], last, rtol=1e-9, atol=1e-12)
    assert [part.shape for part in mean.evaluate(queries[:0])] == [(0, 2), (0, 2, 2)]


def test_a_mean_of_nothing_is_nothing() -> None:
    still = GaussianProcess(CORNERS, np.zeros(4), Hyperparameters(LONG, 1.0, 0.1))
    mean, jacobian = polynomials([still]).evaluate(CORNERS)
    assert not mean.any()
    assert not jacobian.any()


@pytest.mark.parametrize('count', [5, 300])
@pytest.mark.parametrize('lengthscales', [LONG, SHORT])
def test_whichever_way_is_taken_the_mean_is_that_of_the_process(
    count: int, lengthscales: tuple[float, float]
) -> None:
    gps = processes(count, lengthscales, lengthscales, lengthscales)
    outside = np.array([[0.2, 1.0], [0.0, -4.0]])
    for queries in (CORNERS, np.vstack((CORNERS, outside))):
        mean, _ = PosteriorMean(gps, ZeroMean()).evaluate(queries)
        for output, gp in zip(mean.T, gps, strict=True):
            assert np.allclose(output, gp.mean(queries), rtol=1e-9, atol=1e-11)


def test_functions_of_unlike_polynomials_add_up() -> None:
    generator = np.random.default_rng(7)
    first, second = generator.normal(size=(3, 5, 2)), generator.normal(size=(3, 4, 9))
    queries = processes(30, LONG)[0].inputs
    apart = [Polynomials(each).evaluate(queries) for each in (first, second)]
    together = Polynomials(added(first, second)).evaluate(queries)
    for whole, *parts in zip(together, *apart, strict=True):
        assert np.allclose(whole, sum(parts), rtol=1e-9)
