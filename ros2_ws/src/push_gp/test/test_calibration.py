import numpy as np
import pytest
from push_core.push_set import PushSet
from push_gp.calibration import calibration
from push_gp.gp_model import GpModel
from push_gp.hyperparameters import Hyperparameters
from push_gp.mean_function import ZeroMean


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
    found = calibration(flat_model, PushSet(pushes.p_y, pushes.beta, moved, 0.004))
    constant = 0.5 * np.log(2.0 * np.pi)
    expected = constant + np.log([1.0, 2.0, 3.0]) + [0.5, 0.5, 2.0]
    assert np.allclose(found.nlpd, expected, rtol=1e-9)


def test_the_coverage_counts_what_lies_within_1_96_deviations(
    flat_model: GpModel, pushes: PushSet
) -> None:
    moved = np.zeros((60, 3))
    moved[:30] = [1.97e-3, 2e-3 * 1.95, 0.0]
    found = calibration(flat_model, PushSet(pushes.p_y, pushes.beta, moved, 0.004))
    assert found.coverage_95.tolist() == [0.5, 1.0, 1.0]
