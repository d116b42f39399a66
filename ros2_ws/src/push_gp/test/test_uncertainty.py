import numpy as np
import pytest
from push_core.data.push_set import PushSet
from push_gp.evaluation.uncertainty import score_uncertainty
from push_gp.models.gp_model import GpModel
from push_gp.models.mean_function import ZeroMean
from push_gp.regression.kernel import Hyperparameters


@pytest.fixture
def flat_model(pushes: PushSet) -> GpModel:
    """All but sure that nothing moves, with 1 mm, 2 mm and 3 degrees of noise."""
    still = PushSet(pushes.p_y, pushes.beta, np.zeros((60, 3)), 0.004)
    noises = [1e-3, 2e-3, np.radians(3.0)]
    return GpModel.conditioned(
        still, ZeroMean(), [Hyperparameters((0.03, 1.0), 1e-9, noise) for noise in noises]
    )


def test_the_likelihood_is_that_of_a_normal_distribution(
    flat_model: GpModel, pushes: PushSet
) -> None:
    moved = np.tile([1e-3, 2e-3, np.radians(6.0)], (60, 1))
    found = score_uncertainty(flat_model, PushSet(pushes.p_y, pushes.beta, moved, 0.004))
    constant = 0.5 * np.log(2.0 * np.pi)
    expected = constant + np.log([1.0, 2.0, 3.0]) + [0.5, 0.5, 2.0]
    assert np.allclose(found.nlpd, expected, rtol=1e-9)


def test_the_coverage_counts_what_lies_within_the_models_interval(
    flat_model: GpModel, pushes: PushSet
) -> None:
    moved = np.zeros((60, 3))
    reach = flat_model.interval_95 * [1e-3, 2e-3, np.radians(3.0)]
    moved[:30] = reach * [1.001, 0.999, 0.0]
    found = score_uncertainty(flat_model, PushSet(pushes.p_y, pushes.beta, moved, 0.004))
    assert found.coverage_95.tolist() == [0.5, 1.0, 1.0]


def test_the_interval_widens_where_errors_have_heavy_tails_and_is_normal_for_few() -> None:
    generator = np.random.default_rng(8)
    heavy = 1e-3 * generator.standard_t(2.5, (400, 3)) / np.sqrt(5.0)
    spread = np.column_stack((np.linspace(-0.04, 0.04, 400), np.linspace(0.3, 2.8, 400)))
    pushes = PushSet(*spread.T, heavy, 0.004)
    noises = [np.sqrt(np.quantile(column**2, 0.5)) for column in heavy.T]
    hyperparameters = [Hyperparameters((0.03, 1.0), 1e-9, noise) for noise in noises]
    wide = GpModel.conditioned(pushes, ZeroMean(), hyperparameters).interval_95
    assert (wide > 2.5).all()
    few = GpModel.conditioned(pushes.take(np.arange(3)), ZeroMean(), hyperparameters)
    assert np.allclose(few.interval_95, 1.96, atol=0.1)
