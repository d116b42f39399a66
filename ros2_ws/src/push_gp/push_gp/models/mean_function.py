"""What the Gaussian processes are told to expect where no push was seen."""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from push_core.geometry import Array

from push_gp.low_rank import INTERVALS, Interval, covers
from push_gp.models.analytical_model import AnalyticalModel
from push_gp.models.polynomials import Polynomials

MEAN_FUNCTIONS = ('zero', 'analytical')
_BLUR = 0.2  # [rad]
_NODES = np.linspace(-3.5, 3.5, 43)
_SHARES = np.exp(-0.5 * _NODES**2) / np.exp(-0.5 * _NODES**2).sum()
_POLYNOMIALS = (40, 48)  # of p_y and of beta; more would be below 1e-6 of what the cone says


class ZeroMean:
    """The paper's choice: the object stays where it is."""

    coefficients = np.zeros((3, 1, 1))

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`; a zero that broadcasts would hide a wrong length."""
        return np.zeros((len(p_y), 3)), np.zeros((len(p_y), 3, 2))


@dataclass(frozen=True)
class ConeMean:
    """A motion cone without its sharp edge: blurred over the push direction.

    Friction varies from place to place, so measured pushes know no edge, and a process learns what
    is left of them better over a smooth mean. A controller needs that too: the edge is where an
    eight is pushed, and there a plan that keeps to the model's motion cannot be found.

    Within the domain it is the polynomials that agree with the blurred cone at their nodes.
    """

    cone: AnalyticalModel

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`: the expectation for a normally distributed direction."""
        queries = np.column_stack((p_y, beta))
        return self._polynomials.evaluate(queries) if covers(queries) else self._blurred(queries)

    @cached_property
    def coefficients(self) -> Array:
        """(3, p, q): outputs by polynomials of p_y and of beta."""
        nodes = [
            interval.nodes(count) for interval, count in zip(INTERVALS, _POLYNOMIALS, strict=True)
        ]
        places = np.stack(np.meshgrid(*nodes, indexing='ij'), axis=-1)
        values, _ = self._blurred(places.reshape(-1, 2))
        across, around = (Interval.transform(count) for count in _POLYNOMIALS)
        return across @ values.T.reshape(3, *_POLYNOMIALS) @ around.T

    @cached_property
    def _polynomials(self) -> Polynomials:
        return Polynomials(self.coefficients)

    def _blurred(self, queries: Array) -> tuple[Array, Array]:
        directions = queries[:, 1:] + _BLUR * _NODES
        contacts = np.repeat(queries[:, 0], _NODES.size)
        mean, jacobian = self.cone.evaluate(contacts, directions.ravel())
        return (
            np.einsum('k,nki->ni', _SHARES, mean.reshape(-1, _NODES.size, 3)),
            np.einsum('k,nkij->nij', _SHARES, jacobian.reshape(-1, _NODES.size, 3, 2)),
        )


MeanFunction: TypeAlias = ZeroMean | ConeMean
"""The Gaussian processes learn what is left of the displacement over one of these."""
