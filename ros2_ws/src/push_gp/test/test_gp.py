from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from push_core.common.errors import InputError, RunError
from push_core.data.push_set import PushSet
from push_gp.models.posterior_mean import PosteriorMean
from push_gp.regression.gp import GaussianProcess
from push_gp.regression.kernel import Hyperparameters

HYPERPARAMETERS = Hyperparameters((0.03, 1.2), 1.7e-3, 1.4e-4)


@pytest.fixture
def gp(pushes: PushSet) -> GaussianProcess:
    return GaussianProcess(pushes.inputs, pushes.displacement[:, 0], HYPERPARAMETERS)


@pytest.fixture
def points(queries: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    return np.column_stack(queries)


def test_mean_and_variance_are_those_of_scikit_learn(
    gp: GaussianProcess, points: np.ndarray, scikit_learn: Callable[..., Any]
) -> None:
    theirs = scikit_learn(HYPERPARAMETERS, gp.inputs, gp.outputs)
    mean, deviation = theirs.predict(points, return_std=True)
    latent = deviation**2 - HYPERPARAMETERS.noise_std**2
    assert np.abs(gp.mean(points) - mean).max() < 1e-8 * np.abs(mean).max()
    assert np.abs(gp.variance(points) - latent).max() < 1e-8 * latent.max()


def test_one_push_gives_the_closed_form() -> None:
    gp = GaussianProcess(np.array([[0.01, 1.5]]), np.array([0.003]), HYPERPARAMETERS)
    query = np.array([[0.02, 1.8]])
    signal = 1.7e-3**2
    covariance = signal * np.exp(-((0.01 / 0.03) ** 2) - (0.3 / 1.2) ** 2)
    share = covariance / (signal + 1.4e-4**2)
    assert gp.mean(query)[0] == pytest.approx(share * 0.003, rel=1e-12)
    assert gp.variance(query)[0] == pytest.approx(signal - share * covariance, rel=1e-12)


def test_far_from_every_push_it_knows_nothing(gp: GaussianProcess) -> None:
    far = np.array([[10.0, 1.5]])
    assert gp.mean(far)[0] == 0.0
    assert gp.variance(far)[0] == pytest.approx(HYPERPARAMETERS.signal_std**2)


def test_the_variance_is_never_negative() -> None:
    inputs = np.column_stack((np.full(50, 0.01), np.linspace(1.5, 1.5001, 50)))
    sharp = Hyperparameters((0.03, 1.2), 1e-3, 1e-8)
    assert (GaussianProcess(inputs, np.zeros(50), sharp).variance(inputs) >= 0.0).all()


def test_further_pushes_give_what_a_rebuild_gives(
    gp: GaussianProcess, pushes: PushSet, more_pushes: PushSet, points: np.ndarray
) -> None:
    extended = gp.extended(more_pushes.inputs, more_pushes.displacement[:, 0])
    joined = pushes.joined(more_pushes)
    rebuilt = GaussianProcess(joined.inputs, joined.displacement[:, 0], HYPERPARAMETERS)
    assert np.allclose(extended.mean(points), rebuilt.mean(points), rtol=1e-8, atol=0.0)
    assert np.allclose(extended.variance(points), rebuilt.variance(points), rtol=1e-8, atol=0.0)
    assert len(gp.outputs) == len(pushes)


def test_a_singular_covariance_is_an_error_with_a_reason() -> None:
    inputs = np.full((3, 2), 1.0)
    without_noise = Hyperparameters((1.0, 1.0), 1.0, 1e-12)
    with pytest.raises(RunError, match='singular'):
        GaussianProcess(inputs, np.zeros(3), without_noise)


@pytest.mark.parametrize('bad', [0.0, -1.0, np.nan, np.inf])
def test_hyperparameters_are_positive_numbers(bad: float) -> None:
    with pytest.raises(InputError, match='positive'):
        Hyperparameters((0.1, bad), 1.0, 1.0)


def test_the_batched_mean_is_that_of_each_process(
    gp: GaussianProcess, pushes: PushSet, points: np.ndarray
) -> None:
    other = GaussianProcess(
        pushes.inputs, pushes.displacement[:, 2], Hyperparameters((0.02, 0.7), 0.02, 5e-3)
    )
    mean, _ = PosteriorMean([gp, other]).evaluate(points)
    assert np.allclose(mean, np.column_stack((gp.mean(points), other.mean(points))), rtol=1e-10)


def test_a_batch_of_any_length_answers_alike(
    gp: GaussianProcess, monkeypatch: pytest.MonkeyPatch, points: np.ndarray
) -> None:
    batched = PosteriorMean([gp])
    whole = batched.evaluate(points)
    monkeypatch.setattr('push_gp.models.posterior_mean.CACHED_NUMBERS', 7 * len(gp.outputs))
    for in_parts, at_once in zip(batched.evaluate(points), whole, strict=True):
        assert np.allclose(in_parts, at_once, rtol=1e-12)
    assert batched.evaluate(points[:0])[0].shape == (0, 1)
