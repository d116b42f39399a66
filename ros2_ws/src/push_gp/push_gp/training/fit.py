"""Finds the hyperparameters of one output: the maximum of marginal likelihood times prior.

The prior fades as pushes become many; from a few hundred on it is maximum likelihood.

Fully deterministic: fixed starts on a part of the pushes, then ever more pushes from the best.
"""

from collections.abc import Callable, Iterator
from typing import TypeAlias

import numpy as np
from push_core.common import RunError
from push_core.geometry import Array
from scipy.optimize import OptimizeResult, minimize

from push_gp.low_rank.folded_likelihood import FoldedLikelihood
from push_gp.regression import Hyperparameters, MarginalLikelihood
from push_gp.training.prior import Prior

FIRST_STAGE = 300
STAGE_GROWTH = 4
"""The first starts run on 300 pushes; each later stage takes four times as many."""

STARTS = np.log([[1.0, 1.0, 1.0, 1.0], [0.5, 0.5, 1.0, 0.5], [2.0, 2.0, 2.0, 1.0], [1, 1, 0.3, 3]])
"""(k, 4) factors on the prior's centre where the search starts."""

RESTARTS = np.log([[1.0, 1.0, 1.0, 1.0], [0.5, 0.3, 1.0, 0.9]])
"""(k, 4) factors on the best so far where each later stage starts: more pushes may show more
detail than fewer did."""

TRIAL = 10
ENOUGH = 200
"""Iterations after which the best of the starts goes on alone, and with which it surely ends."""

BELIEF = 300
"""Pushes up to which the prior counts in full; it fades with the square of more, so that many
pushes decide alone."""

HOPELESS = 1e25
TOLERANCE = 1e-8
"""Of the log likelihood of a push, which is a few nats."""

Loss: TypeAlias = Callable[[Array], tuple[float, Array]]


def fit(inputs: Array, outputs: Array, prior: Prior) -> Hyperparameters:
    """The most likely hyperparameters.

    Args:
        inputs: (n, 2) contact offsets [m] and directions [rad].
        outputs: (n,) displacements of one kind [m or rad].
        prior: belief about them, with bounds.

    Raises:
        RunError: no start led to a finite likelihood.
    """
    starts = prior.centre + STARTS
    for rows in _stages(len(outputs)):
        loss = _loss(inputs[rows], outputs[rows], prior)
        best = _best(loss, prior, starts)
        starts = best + RESTARTS
    return Hyperparameters.from_logarithms(best)


def _stages(count: int) -> Iterator[slice]:
    """Growing selections, spread evenly over the rows; the last one is everything."""
    size = FIRST_STAGE
    while 2 * size <= count:
        yield slice(None, None, -(-count // size))
        size *= STAGE_GROWTH
    yield slice(None)


def _best(loss: Loss, prior: Prior, starts: Array) -> Array:
    tried = [_climb(loss, prior, start, TRIAL) for start in starts]
    best = min(tried, key=lambda result: float(result.fun))
    if best.fun >= HOPELESS:
        raise RunError('no hyperparameters explain these pushes')
    return np.asarray(_climb(loss, prior, best.x, ENOUGH).x)


def _loss(inputs: Array, outputs: Array, prior: Prior) -> Loss:
    """Negative log posterior of a push [nat] with its gradient (4,).

    Of one push, so that the search's first step, which is as long as the gradient, stays near.
    """
    count = len(outputs)
    few = count <= FIRST_STAGE
    likelihood = (MarginalLikelihood if few else FoldedLikelihood)(inputs, outputs)
    trust = min(1.0, (BELIEF / count) ** 2)

    def loss(logarithms: Array) -> tuple[float, Array]:
        try:
            value, slope = likelihood.with_gradient(Hyperparameters.from_logarithms(logarithms))
        except RunError:
            return HOPELESS, np.zeros(4)
        belief, belief_slope = prior.with_gradient(logarithms)
        return -(value + trust * belief) / count, -(slope + trust * belief_slope) / count

    return loss


def _climb(loss: Loss, prior: Prior, start: Array, iterations: int) -> OptimizeResult:
    return minimize(
        loss,
        np.clip(start, prior.low, prior.high),
        jac=True,
        method='L-BFGS-B',
        bounds=list(zip(prior.low, prior.high, strict=True)),
        options={'ftol': TOLERANCE, 'maxiter': iterations},
    )
