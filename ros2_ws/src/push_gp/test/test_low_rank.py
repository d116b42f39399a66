"""The low-rank form changes the cost of a prediction, not the prediction."""

import numpy as np
import pytest
from push_gp.low_rank.chebyshev import Interval
from push_gp.low_rank.kernel_modes import KernelModes
from push_gp.low_rank.low_rank_process import LowRankProcess, conditioned
from push_gp.regression.gp import GaussianProcess
from push_gp.regression.kernel import Hyperparameters
from push_gp.regression.likelihood import MarginalLikelihood
from push_gp.training.low_rank_likelihood import LowRankLikelihood

SMOOTH = Hyperparameters((0.03, 1.2), 1.7e-3, 1.4e-4)
ROUGH = Hyperparameters((0.016, 1.0), 1.7e-3, 1.4e-4)
JAGGED = Hyperparameters((0.002, 0.1), 1.7e-3, 1.4e-4)
QUERIES = np.random.default_rng(5).uniform([-0.05, 0.01], [0.05, 3.13], (60, 2))


@pytest.fixture(scope='module')
def data() -> tuple[np.ndarray, np.ndarray]:
    generator = np.random.default_rng(6)
    inputs = generator.uniform([-0.045, 0.1], [0.045, 3.0], (900, 2))
    outputs = 2e-3 * np.sin(40.0 * inputs[:, 0]) * np.sin(inputs[:, 1])
    return inputs, outputs + 1.4e-4 * generator.normal(size=900)


@pytest.mark.parametrize('lengthscales', [(0.04, 2.0), (0.01, 0.5), (0.004, 0.2)])
def test_the_features_give_the_kernel(lengthscales: tuple[float, float]) -> None:
    intervals = [Interval(0.0, 0.05), Interval(np.pi / 2.0, np.pi / 2.0)]
    features = KernelModes.of(intervals, lengthscales).features(QUERIES)
    gap = (QUERIES[:, None] - QUERIES) / lengthscales
    kernel = np.exp(-np.sum(gap**2, axis=-1))
    assert np.abs(features @ features.T - kernel).max() < 1e-12


@pytest.mark.parametrize('hyperparameters', [SMOOTH, ROUGH, JAGGED])
def test_the_likelihood_and_its_gradient_are_those_of_all_covariances(
    data: tuple[np.ndarray, np.ndarray], hyperparameters: Hyperparameters
) -> None:
    value, gradient = MarginalLikelihood(*data).with_gradient(hyperparameters)
    low_rank, low_rank_gradient = LowRankLikelihood(*data).with_gradient(hyperparameters)
    assert low_rank == pytest.approx(value, rel=1e-8)
    assert np.allclose(low_rank_gradient, gradient, rtol=1e-6, atol=1e-7 * abs(value))


def test_the_likelihood_depends_on_its_point_and_not_on_the_way_there(
    data: tuple[np.ndarray, np.ndarray],
) -> None:
    likelihood = LowRankLikelihood(*data)
    direct = likelihood.with_gradient(SMOOTH)[0]
    likelihood.with_gradient(ROUGH)
    assert likelihood.with_gradient(SMOOTH)[0] == pytest.approx(direct, rel=1e-8)


@pytest.mark.parametrize('hyperparameters', [SMOOTH, ROUGH])
def test_the_low_rank_process_equals_the_full_rank_one(
    data: tuple[np.ndarray, np.ndarray], hyperparameters: Hyperparameters
) -> None:
    low_rank, plain = conditioned(*data, hyperparameters), GaussianProcess(*data, hyperparameters)
    assert isinstance(low_rank, LowRankProcess)
    assert np.allclose(
        low_rank.weights, plain.weights, rtol=0, atol=1e-9 * abs(plain.weights).max()
    )
    assert np.allclose(low_rank.variance(QUERIES), plain.variance(QUERIES), rtol=1e-8, atol=0)
    off_the_face = np.array([[0.06, 1.0]])
    assert np.allclose(low_rank.variance(off_the_face), plain.variance(off_the_face), rtol=1e-9)
    for ours, theirs in zip(low_rank.left_out(), plain.left_out(), strict=True):
        assert np.allclose(ours, theirs, rtol=1e-7, atol=1e-9 * np.abs(theirs).max())


def test_short_lengthscales_use_the_full_covariance(data: tuple[np.ndarray, np.ndarray]) -> None:
    assert isinstance(conditioned(*data, JAGGED), GaussianProcess)


def test_what_is_left_out_is_predicted_by_the_others() -> None:
    generator = np.random.default_rng(7)
    inputs, outputs = generator.uniform(0.0, 0.04, (6, 2)), generator.normal(size=6)
    errors, variances = GaussianProcess(inputs, outputs, SMOOTH).left_out()
    others = GaussianProcess(inputs[1:], outputs[1:], SMOOTH)
    assert errors[0] == pytest.approx(outputs[0] - others.mean(inputs[:1])[0])
    noise = SMOOTH.noise_std**2
    assert variances[0] == pytest.approx(others.variance(inputs[:1])[0] + noise)


def test_added_pushes_give_the_process_of_all_pushes(
    data: tuple[np.ndarray, np.ndarray],
) -> None:
    inputs, outputs = data
    extended = conditioned(inputs[:880], outputs[:880], SMOOTH).extended(
        inputs[880:], outputs[880:]
    )
    plain = GaussianProcess(*data, SMOOTH)
    assert isinstance(extended, LowRankProcess)
    largest = abs(plain.weights).max()
    assert np.allclose(extended.weights, plain.weights, rtol=0, atol=1e-8 * largest)
    assert np.allclose(extended.variance(QUERIES), plain.variance(QUERIES), rtol=1e-8, atol=0)
