"""Prior mean of the Gaussian processes: what they predict where there are no pushes."""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebvander
from push_core.geometry import Array

from push_gp.low_rank import CENTRE, HALF_WIDTH, INTERVALS, Interval, covers
from push_gp.models.analytical_model import AnalyticalModel

MEAN_FUNCTIONS = ('zero', 'analytical')
_BLUR = 0.2
"""Standard deviation [rad] of the push direction over which the motion cone is averaged."""

_NODES = np.linspace(-3.5, 3.5, 43)
_SHARES = np.exp(-0.5 * _NODES**2) / np.exp(-0.5 * _NODES**2).sum()
_COUNTS = (40, 48)
"""Polynomials of p_y and of beta; further coefficients are below 1e-6 of the displacement."""


class ZeroMean:
    """The paper's choice: the object does not move."""

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`."""
        # a scalar zero would broadcast and hide a wrong length
        return np.zeros((len(p_y), 3)), np.zeros((len(p_y), 3, 2))


@dataclass(frozen=True)
class ConeMean:
    """A motion cone averaged over the push direction, which removes its sharp edge.

    Friction varies from place to place, so measured pushes show no edge, and a process learns the
    residuals better over a smooth mean. A controller needs that too: an eight is pushed at the
    edge, and there a plan that agrees with the model's motion cannot be found.

    The average is interpolated by Chebyshev polynomials. The sum over 43 directions alone has 43
    small kinks, where its Jacobian jumps, and costs 43 evaluations of the cone for each query.
    """

    cone: AnalyticalModel

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`."""
        queries = np.column_stack((p_y, beta))
        return self._interpolated(queries) if covers(queries) else self._averaged(queries)

    def _interpolated(self, queries: Array) -> tuple[Array, Array]:
        across, around = (
            chebvander(column, count - 1)
            for column, count in zip(((queries - CENTRE) / HALF_WIDTH).T, _COUNTS, strict=True)
        )
        along_beta = (across @ self._coefficients).reshape(len(queries), 3, 3, -1)
        values = np.einsum('nikq,nq->nik', along_beta, around)
        return values[..., 0], values[..., 1:]

    @cached_property
    def _coefficients(self) -> Array:
        """(p, 9 q), for each output of its value and its derivatives by p_y and by beta."""
        nodes = [interval.nodes(count) for interval, count in zip(INTERVALS, _COUNTS, strict=True)]
        points = np.stack(np.meshgrid(*nodes, indexing='ij'), axis=-1)
        values, _ = self._averaged(points.reshape(-1, 2))
        across, around = (Interval.transform(count) for count in _COUNTS)
        mean = np.einsum('ap,pqi,bq->aib', across, values.reshape(*_COUNTS, 3), around)
        table = np.zeros((_COUNTS[0], 3, 3, _COUNTS[1]))
        table[:, :, 0] = mean
        table[:-1, :, 1] = chebder(mean, axis=0) / HALF_WIDTH[0]
        table[:, :, 2, :-1] = chebder(mean, axis=2) / HALF_WIDTH[1]
        return table.reshape(_COUNTS[0], -1)

    def _averaged(self, queries: Array) -> tuple[Array, Array]:
        return averaged(self.cone, queries, _BLUR)


def averaged(cone: AnalyticalModel, queries: Array, blur: float) -> tuple[Array, Array]:
    """A motion cone averaged over normally distributed push directions.

    Args:
        cone: of any slider.
        queries: (n, 2) contact offsets [m] and push directions [rad].
        blur: standard deviation of the push direction [rad].

    Returns:
        Mean (n, 3) and Jacobian (n, 3, 2), see `PushModel.evaluate`.
    """
    directions = queries[:, 1:] + blur * _NODES
    contacts = np.repeat(queries[:, 0], _NODES.size)
    mean, jacobian = cone.evaluate(contacts, directions.ravel())
    return (
        np.einsum('k,nki->ni', _SHARES, mean.reshape(-1, _NODES.size, 3)),
        np.einsum('k,nkij->nij', _SHARES, jacobian.reshape(-1, _NODES.size, 3, 2)),
    )


MeanFunction: TypeAlias = ZeroMean | ConeMean
"""The Gaussian processes learn the residuals of the displacement over one of these."""
