"""Fits the hyperparameters of one output: maximum of marginal likelihood times prior.

The weight of the prior decreases from 300 pushes on; with thousands it is maximum likelihood.

The search is deterministic: fixed starts on a part of the pushes, then stages with more pushes
that start at the best result so far.
"""

from collections.abc import Callable, Iterator
from typing import TypeAlias

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from scipy.optimize import OptimizeResult, minimize

from push_gp.regression import Hyperparameters, MarginalLikelihood
from push_gp.training.low_rank_likelihood import LowRankLikelihood
from push_gp.training.prior import Prior

FIRST_STAGE = 300
STAGE_GROWTH = 4
"""Pushes of the first stage, and the factor by which each later stage has more."""

STARTS = np.log([[1.0, 1.0, 1.0, 1.0], [0.5, 0.5, 1.0, 0.5], [2.0, 2.0, 2.0, 1.0], [1, 1, 0.3, 3]])
"""(k, 4) factors on the prior's centre: starts of the first stage."""

RESTARTS = np.log([[1.0, 1.0, 1.0, 1.0], [0.5, 0.3, 1.0, 0.9]])
"""(k, 4) factors on the best result so far: starts of each later stage. Shorter lengthscales are
among them because more pushes may show more detail."""

TRIAL_ITERATIONS = 10
MOST_ITERATIONS = 200
"""Limits for each start, and for the best of them, which continues alone."""

FULL_PRIOR = 300
"""Number of pushes up to which the prior has its full weight. With n pushes the weight is
(300 / n)^2, so that the data of many pushes decide."""

FAILED = 1e25
"""Loss where the covariance is singular."""

TOLERANCE = 1e-8
"""Of the optimiser, in log likelihood per push [nat]."""

Loss: TypeAlias = Callable[[Array], tuple[float, Array]]


def fit(inputs: Array, outputs: Array, prior: Prior) -> Hyperparameters:
    """The most likely hyperparameters.

    Args:
        inputs: (n, 2) contact offsets [m] and directions [rad].
        outputs: (n,) displacements of one kind [m or rad].
        prior: of the hyperparameters, with bounds.

    Raises:
        RunError: no start leads to a finite likelihood.
    """
    starts = prior.centre + STARTS
    for rows in _stages(len(outputs)):
        loss = _loss(inputs[rows], outputs[rows], prior)
        best = _best(loss, prior, starts)
        starts = best + RESTARTS
    return Hyperparameters.from_logarithms(best)


def _stages(count: int) -> Iterator[slice]:
    """Growing selections, spread evenly over the rows; the last one has all rows."""
    size = FIRST_STAGE
    while 2 * size <= count:
        yield slice(None, None, -(-count // size))
        size *= STAGE_GROWTH
    yield slice(None)


def _best(loss: Loss, prior: Prior, starts: Array) -> Array:
    results = [_minimised(loss, prior, start, TRIAL_ITERATIONS) for start in starts]
    best = min(results, key=lambda result: float(result.fun))
    if best.fun >= FAILED:
        raise RunError('no hyperparameters explain these pushes')
    return np.asarray(_minimised(loss, prior, best.x, MOST_ITERATIONS).x)


def _loss(inputs: Array, outputs: Array, prior: Prior) -> Loss:
    """Negative log posterior per push [nat] with its gradient (4,).

    Per push, because the first step of the optimiser is as long as the gradient.
    """
    count = len(outputs)
    few = count <= FIRST_STAGE
    likelihood = (MarginalLikelihood if few else LowRankLikelihood)(inputs, outputs)
    weight = min(1.0, (FULL_PRIOR / count) ** 2)

    def loss(logarithms: Array) -> tuple[float, Array]:
        try:
            value, slope = likelihood.with_gradient(Hyperparameters.from_logarithms(logarithms))
        except RunError:
            return FAILED, np.zeros(4)
        prior_value, prior_slope = prior.with_gradient(logarithms)
        return -(value + weight * prior_value) / count, -(slope + weight * prior_slope) / count

    return loss


def _minimised(loss: Loss, prior: Prior, start: Array, iterations: int) -> OptimizeResult:
    return minimize(
        loss,
        np.clip(start, prior.low, prior.high),
        jac=True,
        method='L-BFGS-B',
        bounds=list(zip(prior.low, prior.high, strict=True)),
        options={'ftol': TOLERANCE, 'maxiter': iterations},
    )
