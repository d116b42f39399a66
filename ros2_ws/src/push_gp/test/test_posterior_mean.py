"""The mean of a model is its prior mean plus the means of its processes, for all inputs."""

import numpy as np
import pytest
from push_core.data.push_set import P_Y_LIMIT, PushSet
from push_gp.models.analytical_model import AnalyticalModel
from push_gp.models.gp_model import GpModel, residuals
from push_gp.models.mean_function import ConeMean, MeanFunction, ZeroMean
from push_gp.models.posterior_mean import PosteriorMean
from push_gp.regression.gp import GaussianProcess
from push_gp.regression.kernel import Hyperparameters

LONG, SHORT = (0.02, 0.7), (0.003, 0.2)
CORNERS = np.array([[y, beta] for y in (-P_Y_LIMIT, P_Y_LIMIT) for beta in (1e-9, np.pi - 1e-9)])
OUTSIDE = np.array([[0.2, 1.0], [0.0, -4.0]])


def some_pushes(count: int) -> PushSet:
    generator = np.random.default_rng(4)
    p_y, beta = generator.uniform([-0.045, 0.1], [0.045, 3.0], (count, 2)).T
    return PushSet(p_y, beta, 1e-3 * generator.normal(size=(count, 3)), 0.004)


@pytest.mark.parametrize('mean_function', [ZeroMean(), ConeMean(AnalyticalModel())])
@pytest.mark.parametrize('count', [5, 300])
@pytest.mark.parametrize('lengthscales', [LONG, SHORT])
def test_the_mean_is_that_of_an_exact_process_plus_the_prior_mean(
    count: int, lengthscales: tuple[float, float], mean_function: MeanFunction
) -> None:
    pushes = some_pushes(count)
    hyperparameters = Hyperparameters(lengthscales, 1e-3, 1e-4)
    model = GpModel.conditioned(pushes, mean_function, [hyperparameters] * 3)
    for queries in (CORNERS, np.vstack((CORNERS, OUTSIDE))):
        prior, _ = mean_function.evaluate(*queries.T)
        mean, _ = model.evaluate(*queries.T)
        for column, outputs in enumerate(residuals(pushes, mean_function)):
            exact = GaussianProcess(pushes.inputs, outputs, hyperparameters).mean(queries)
            assert np.allclose(mean[:, column] - prior[:, column], exact, rtol=1e-9, atol=1e-13)


def test_processes_with_zero_outputs_predict_zero() -> None:
    still = GaussianProcess(CORNERS, np.zeros(4), Hyperparameters(LONG, 1.0, 0.1))
    mean, jacobian = PosteriorMean([still]).evaluate(CORNERS)
    assert not mean.any()
    assert not jacobian.any()
