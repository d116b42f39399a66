"""What the Gaussian processes are told to expect where no push was seen."""

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from push_core.frames import Array

from push_gp.analytical_model import AnalyticalModel

MEAN_FUNCTIONS = ('zero', 'analytical')
_BLUR = 0.2  # [rad]
# evenly, so that no place of them has the edge to itself
_NODES = np.linspace(-2.0, 2.0, 11)
_SHARES = np.exp(-0.5 * _NODES**2) / np.exp(-0.5 * _NODES**2).sum()


class ZeroMean:
    """The paper's choice: the object stays where it is."""

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`; a zero that broadcasts would hide a wrong length."""
        return np.zeros((len(p_y), 3)), np.zeros((len(p_y), 3, 2))


@dataclass(frozen=True)
class ConeMean:
    """A motion cone without its sharp edge: blurred over the push direction.

    Friction varies from place to place, so measured pushes know no edge, and a process learns what
    is left of them better over a smooth mean. A controller needs that too: the edge is where an
    eight is pushed, and there a plan that keeps to the model's motion cannot be found.
    """

    cone: AnalyticalModel

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """See `PushModel.evaluate`: the expectation for a normally distributed direction."""
        directions = np.asarray(beta)[:, None] + _BLUR * _NODES
        contacts = np.repeat(p_y, _NODES.size)
        mean, jacobian = self.cone.evaluate(contacts, directions.ravel())
        return (
            np.einsum('k,nki->ni', _SHARES, mean.reshape(-1, _NODES.size, 3)),
            np.einsum('k,nkij->nij', _SHARES, jacobian.reshape(-1, _NODES.size, 3, 2)),
        )


MeanFunction: TypeAlias = ZeroMean | ConeMean
"""The Gaussian processes learn what is left of the displacement over one of these."""
