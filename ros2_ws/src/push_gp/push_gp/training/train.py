"""Training: from pushes to a model."""

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
    """Trains a model; the same pushes give the same model bit for bit.

    It uses one thread. Several would sum in another order, gain little with matrices of a few
    hundred rows, and wait for each other when other work occupies a core.

    Args:
        pushes: the training set.
        mean: 'zero' as in the paper, or 'analytical' for the fitted motion cone.
        progress: called with the name of each output when it is fitted.

    Raises:
        RunError: no hyperparameters explain the pushes.
    """
    with threadpool_limits(1, 'blas'):
        return _trained(pushes, mean, progress)


def _trained(pushes: PushSet, mean: str, progress: Callable[[str], object]) -> GpModel:
    mean_function = _mean_function(pushes, mean)
    values = OVER_CONE if isinstance(mean_function, ConeMean) else OVER_ZERO
    fitted = []
    columns = residuals(pushes, mean_function)
    for name, outputs, prior in zip(
        OUTPUTS, columns, priors(values, pushes.distance), strict=True
    ):
        fitted.append(fit(pushes.inputs, outputs, prior))
        progress(name)
    return GpModel.conditioned(pushes, mean_function, fitted)


def _mean_function(pushes: PushSet, mean: str) -> MeanFunction:
    return ConeMean(fitted_cone(pushes)) if mean == 'analytical' else ZeroMean()
