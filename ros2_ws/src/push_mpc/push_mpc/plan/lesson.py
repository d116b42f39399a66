"""What laps have taught the controller beside the table of its model."""

from dataclasses import dataclass, field, replace

import numpy as np
from push_core.geometry import Array, rotation
from push_core.physics import Slider

from push_mpc.plan.nominal import Plan


def _no_shift() -> Array:
    return np.zeros((0, 2))


@dataclass(frozen=True)
class Lesson:
    """What laps have taught.

    Attributes:
        slider: with the identified friction and support radius; None before anything is.
        shift: (n, 2) of the reference [m] at every sample of one lap, in the frame of the plan's
            first pose; (0, 2) for none.
    """

    slider: Slider | None = None
    shift: Array = field(default_factory=_no_shift)

    def reference(self, plan: Plan) -> Plan:
        """The plan with its positions shifted in every lap."""
        if not len(self.shift):
            return plan
        rows = np.arange(len(plan.state)) % len(self.shift)
        state = plan.state.copy()
        state[:, :2] += self.shift[rows] @ rotation(plan.state[0, 2]).T
        return replace(plan, state=state)
