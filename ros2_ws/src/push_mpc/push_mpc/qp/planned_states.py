"""The states that the programs of one tick plan, written down only when somebody wants them."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

from push_mpc.plan import Plan
from push_mpc.qp.stages import STATE_SCALE


@dataclass(frozen=True)
class PlannedStates:
    """The horizon of one tick; good until the next one is prepared.

    Attributes:
        plan: about which was planned.
        samples: of the plan, one for each planned state (N + 1,).
        deviations: from them, as the solver sees them (N + 1, 4).
    """

    plan: Plan
    samples: Array
    deviations: Array

    def write(self, states: Array, scratch: Array) -> None:
        """Writes the states (N + 1, 4) [m, m, rad, m]; makes no array of its own.

        Args:
            states: filled.
            scratch: of the same shape, spoilt.
        """
        np.take(self.plan.state, self.samples, axis=0, out=scratch, mode='clip')
        np.multiply(self.deviations, STATE_SCALE, out=states)
        states += scratch
