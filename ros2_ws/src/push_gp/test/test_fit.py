import numpy as np
import pytest
from push_core.data.push_set import PushSet
from push_gp.regression.kernel import Hyperparameters, correlation, squared_differences
from push_gp.regression.likelihood import MarginalLikelihood
from push_gp.training import fit as fit_module
from push_gp.training.fit import fit
from push_gp.training.prior import OVER_ZERO, priors
from push_gp.training.train import train
from threadpoolctl import threadpool_limits

TRUE = Hyperparameters((0.03, 1.2), 1.7e-3, 1.4e-4)
PRIOR = priors(OVER_ZERO, 0.004)[0]


def sample(count: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A function drawn from the very process that shall be found again."""
    generator = np.random.default_rng(seed)
    inputs = generator.uniform([-0.045, 0.1], [0.045, 3.0], (count, 2))
    covariance = TRUE.signal_std**2 * correlation(squared_differences(inputs), TRUE.lengthscales)
    covariance += TRUE.noise_std**2 * np.eye(count)
    return inputs, np.linalg.cholesky(covariance) @ generator.normal(size=count)


def test_the_fit_finds_the_hyperparameters_that_made_the_data() -> None:
    found = fit(*sample(400, seed=1), PRIOR)
    assert found.lengthscales == pytest.approx(TRUE.lengthscales, rel=0.25)
    assert found.signal_std == pytest.approx(TRUE.signal_std, rel=0.5)
    assert found.noise_std == pytest.approx(TRUE.noise_std, rel=0.1)


def test_the_fit_is_at_least_as_likely_as_the_truth() -> None:
    inputs, outputs = sample(200, seed=2)
    likelihood = MarginalLikelihood(inputs, outputs)
    found, _ = likelihood.with_gradient(fit(inputs, outputs, PRIOR))
    assert found > likelihood.with_gradient(TRUE)[0] - 0.5


def test_stages_end_where_one_go_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    inputs, outputs = sample(120, seed=3)
    at_once = fit(inputs, outputs, PRIOR)
    monkeypatch.setattr(fit_module, 'FIRST_STAGE', 20)
    staged = fit(inputs, outputs, PRIOR)
    assert np.allclose(staged.as_logarithms(), at_once.as_logarithms(), atol=1e-2)


@pytest.mark.parametrize('count', [1, 2, 5])
@pytest.mark.parametrize('mean', ['zero', 'analytical'])
def test_a_handful_of_pushes_gives_a_sane_model(pushes: PushSet, count: int, mean: str) -> None:
    info = train(pushes.take(np.arange(count)), mean).info
    assert (info.lengthscales[:, 0] > 0.005).all()
    assert (info.lengthscales[:, 0] < 0.2).all()
    assert (info.signal_std < [5e-3, 5e-3, 0.1]).all()
    assert (info.noise_std > [4e-5, 4e-5, 1e-3]).all()
    assert (info.noise_std < [5e-4, 5e-4, 1e-2]).all()


def test_repeated_pushes_are_no_trouble(pushes: PushSet) -> None:
    rows = np.zeros(20, dtype=np.intp)
    mean, _ = train(pushes.take(rows)).evaluate(pushes.p_y[:1], pushes.beta[:1])
    assert np.allclose(mean, pushes.displacement[:1], rtol=0.1, atol=1e-4)


def test_the_same_pushes_give_the_same_model_bit_for_bit(pushes: PushSet) -> None:
    assert train(pushes).info.model_hash == train(pushes).info.model_hash


def test_the_number_of_threads_changes_no_bit(many_pushes: PushSet) -> None:
    hashes = set()
    for threads in (1, 2):
        with threadpool_limits(threads, 'blas'):
            hashes.add(train(many_pushes).info.model_hash)
    assert len(hashes) == 1
