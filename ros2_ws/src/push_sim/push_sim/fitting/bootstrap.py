"""Standard deviations of least-squares estimates by a bootstrap."""

import numpy as np
from push_core.geometry import Array

_DRAWS = 1000


def bootstrap_deviation(residual: Array, jacobian: Array, seed: int) -> Array:
    """Standard deviations (p,) of p fitted parameters.

    Args:
        residual: (n, k) residuals of n measurements; a measurement is drawn with all its k values.
        jacobian: (n, k, p) derivatives of the residuals by the parameters, at the optimum.
        seed: seed of the draws.

    The fit to each draw is one Gauss-Newton step from the optimum. Source: Efron 1979.
    """
    count = len(residual)
    random = np.random.default_rng(seed)
    weights = random.multinomial(count, np.full(count, 1.0 / count), size=_DRAWS)
    curvature = np.einsum('nkp,nkq->npq', jacobian, jacobian)
    slope = np.einsum('nkp,nk->np', jacobian, residual)
    matrices = np.einsum('dn,npq->dpq', weights, curvature)
    steps = np.linalg.solve(matrices, (weights @ slope)[..., None])[..., 0]
    return np.asarray(steps.std(axis=0))
