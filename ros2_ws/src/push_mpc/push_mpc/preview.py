"""The linearised dynamics along the whole plan, computed once for each plan and model."""

from dataclasses import dataclass

import numpy as np
from push_core.frames import Array

from push_mpc.dynamics import TravelModel, discretised, linearised, rates
from push_mpc.nominal import Plan


@dataclass(frozen=True)
class Preview:
    """Transitions of one horizon step from every sample of a plan.

    Attributes:
        transition: A (n, 4, 4).
        effect: B (n, 4, 2).
        drift: c (n, 4): motion of the model along the plan minus that of the plan.
        input: nominal input at the start of the step (n, 2) [m/s].
        contact: nominal p_y at the end of the step (n,) [m].
    """

    transition: Array
    effect: Array
    drift: Array
    input: Array
    contact: Array

    @classmethod
    def of(cls, plan: Plan, model: TravelModel, tip_x: float, stride: int) -> 'Preview':
        """Linearises a model about a plan."""
        by_state, by_input = linearised(model, plan.state, plan.input, tip_x)
        # what the plan misses acts like one more input that is always 1
        inputs = np.concatenate([by_input, _missed(plan, model, tip_x)[:, :, None]], axis=-1)
        transition, effect = discretised(by_state, inputs, stride, plan.period)
        index = np.arange(len(plan.state))
        ahead = np.minimum(index + stride, len(index) - 1)
        contact = plan.state[ahead, 3]
        return cls(transition, effect[:, :, :2], effect[:, :, 2], plan.input, contact)


def _missed(plan: Plan, model: TravelModel, tip_x: float) -> Array:
    """How fast the model's motion at the nominal leaves the plan, (n, 4)."""
    motion = rates(model, plan.state, plan.input, tip_x)
    return np.asarray(motion - np.gradient(plan.state, plan.period, axis=0))
