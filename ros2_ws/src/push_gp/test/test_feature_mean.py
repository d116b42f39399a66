import numpy as np
import pytest
from push_core.push_set import P_Y_LIMIT
from push_gp.batched_mean import BatchedMean
from push_gp.feature_mean import FeatureMean
from push_gp.gp import GaussianProcess
from push_gp.hyperparameters import Hyperparameters
from push_gp.kernel_features import MOST_FEATURES, enough_features, feature_slopes, features
from push_gp.posterior_mean import WORTH_FOLDING, PosteriorMean

LONG, SHORT = (0.02, 0.7), (0.003, 0.7)
CORNERS = np.array([[y, beta] for y in (-P_Y_LIMIT, P_Y_LIMIT) for beta in (1e-9, np.pi - 1e-9)])


def processes(count: int, *lengthscales: tuple[float, float]) -> list[GaussianProcess]:
    generator = np.random.default_rng(4)
    inputs = generator.uniform([-0.045, 0.1], [0.045, 3.0], (count, 2))
    return [
        GaussianProcess(inputs, generator.normal(size=count), Hyperparameters(lengths, 1.0, 0.1))
        for lengths in lengthscales
    ]


@pytest.mark.parametrize('reach', [0.3, 1.7, 5.0])
def test_enough_features_give_the_kernel_to_round_off(reach: float) -> None:
    points = np.linspace(-reach, reach, 41)
    count = enough_features(reach)
    values = features(points, count)
    kernel = np.exp(-((points[:, None] - points) ** 2))
    assert np.abs(values.T @ values - kernel).max() < 1e-14
    assert np.abs(values[: count // 2].T @ values[: count // 2] - kernel).max() > 1e-14


def test_the_slopes_of_the_features_are_their_finite_differences() -> None:
    points, step = np.array([-1.3, 0.0, 0.4]), 1e-6
    differences = (features(points + step, 12) - features(points - step, 12)) / (2.0 * step)
    assert np.allclose(feature_slopes(points, features(points, 12)), differences, atol=1e-9)


def test_folded_pushes_give_the_mean_and_jacobian_of_the_pushes() -> None:
    gps = processes(300, LONG, (0.05, 2.0))
    queries = np.vstack((gps[0].inputs[:50], CORNERS))
    for ours, theirs in zip(
        FeatureMean(gps).evaluate(queries), BatchedMean(gps).evaluate(queries), strict=True
    ):
        assert np.abs(ours - theirs).max() < 1e-11 * np.abs(theirs).max()


def test_lengthscales_too_short_to_fold_are_known() -> None:
    assert FeatureMean.suits(processes(5, LONG))
    assert not FeatureMean.suits(processes(5, LONG, SHORT))
    assert enough_features(30.0) == MOST_FEATURES + 1


@pytest.mark.parametrize('count', [WORTH_FOLDING - 1, WORTH_FOLDING])
@pytest.mark.parametrize('lengthscales', [LONG, SHORT])
def test_whichever_way_is_taken_the_mean_is_that_of_the_process(
    count: int, lengthscales: tuple[float, float]
) -> None:
    (gp,) = processes(count, lengthscales)
    outside = np.array([[0.2, 1.0], [0.0, -4.0]])
    for queries in (CORNERS, np.vstack((CORNERS, outside))):
        mean, _ = PosteriorMean([gp]).evaluate(queries)
        assert np.allclose(mean[:, 0], gp.mean(queries), rtol=1e-9, atol=1e-12)
