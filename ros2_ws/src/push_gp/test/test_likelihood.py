from collections.abc import Callable
from typing import Any

import numpy as np
from push_core.data.push_set import PushSet
from push_gp.regression.kernel import Hyperparameters
from push_gp.regression.likelihood import MarginalLikelihood

HYPERPARAMETERS = Hyperparameters((0.03, 1.2), 1.7e-3, 1.4e-4)


def test_the_gradient_is_that_of_finite_differences(pushes: PushSet) -> None:
    likelihood = MarginalLikelihood(pushes.inputs, pushes.displacement[:, 0])
    logarithms, step = HYPERPARAMETERS.as_logarithms(), 1e-5

    def value(at: np.ndarray) -> float:
        return likelihood.with_gradient(Hyperparameters.from_logarithms(at))[0]

    differences = [
        (value(logarithms + step * unit) - value(logarithms - step * unit)) / (2.0 * step)
        for unit in np.eye(4)
    ]
    _, gradient = likelihood.with_gradient(HYPERPARAMETERS)
    assert np.allclose(gradient, differences, rtol=1e-6)


def test_the_likelihood_is_that_of_scikit_learn(
    pushes: PushSet, scikit_learn: Callable[..., Any]
) -> None:
    outputs = pushes.displacement[:, 0]
    fitted = scikit_learn(HYPERPARAMETERS, pushes.inputs, outputs)
    theirs = fitted.log_marginal_likelihood_value_
    ours, _ = MarginalLikelihood(pushes.inputs, outputs).with_gradient(HYPERPARAMETERS)
    assert abs(ours - theirs) < 1e-8 * abs(theirs)


def test_logarithms_and_back_is_the_identity() -> None:
    again = Hyperparameters.from_logarithms(HYPERPARAMETERS.as_logarithms())
    assert np.allclose(again.as_logarithms(), HYPERPARAMETERS.as_logarithms(), rtol=1e-15)
