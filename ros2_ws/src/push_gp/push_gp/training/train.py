"""From pushes to a model."""

from collections.abc import Callable

from push_core.data import OUTPUTS, PushSet
from threadpoolctl import threadpool_limits

from push_gp.models import ConeMean, GpModel, MeanFunction, ZeroMean, residuals
from push_gp.training.fit import fit
from push_gp.training.fit_cone import fitted_cone
from push_gp.training.prior import OVER_CONE, OVER_ZERO, priors


def train(
    pushes: PushSet, mean: str = 'zero', progress: Callable[[str], object] = lambda _output: None
) -> GpModel:
    """The most likely model of a push set; the same set gives the same model bit for bit.

    One thread does it. Several would sum in another order, and gain little with matrices of a few
    hundred rows; where other work keeps a core busy they would wait for each other.

    Args:
        pushes: the training set.
        mean: 'zero' as in the paper, or 'analytical': the motion cone, itself fitted.
        progress: told the name of each output that is done.

    Raises:
        RunError: no hyperparameters explain the pushes.
    """
    with threadpool_limits(1, 'blas'):
        return _trained(pushes, mean, progress)


def _trained(pushes: PushSet, mean: str, progress: Callable[[str], object]) -> GpModel:
    mean_function = _mean_function(pushes, mean)
    beliefs = OVER_CONE if isinstance(mean_function, ConeMean) else OVER_ZERO
    found = []
    left = residuals(pushes, mean_function)
    for name, outputs, prior in zip(OUTPUTS, left, priors(beliefs, pushes.distance), strict=True):
        found.append(fit(pushes.inputs, outputs, prior))
        progress(name)
    return GpModel.conditioned(pushes, mean_function, found)


def _mean_function(pushes: PushSet, mean: str) -> MeanFunction:
    return ConeMean(fitted_cone(pushes)) if mean == 'analytical' else ZeroMean()
