"""The planned states of one tick, computed only when they are published."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

from push_mpc.plan import Plan
from push_mpc.qp.stages import STATE_SCALE


@dataclass(frozen=True)
class PlannedStates:
    """The planned states over the horizon; valid until the next tick is prepared.

    Attributes:
        plan: the nominal.
        samples: indices into the plan, one for each planned state (N + 1,).
        deviations: of the planned states from these samples (N + 1, 4), in the solver's units.
    """

    plan: Plan
    samples: Array
    deviations: Array

    def write(self, states: Array, scratch: Array) -> None:
        """Writes the states (N + 1, 4) [m, m, rad, m] without allocating.

        Args:
            states: receives the states.
            scratch: array of the same shape, overwritten.
        """
        np.take(self.plan.state, self.samples, axis=0, out=scratch, mode='clip')
        np.multiply(self.deviations, STATE_SCALE, out=states)
        states += scratch
