"""The linearised dynamics along the whole plan, computed once for each plan and model."""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array

from push_mpc.motion import Motion, discretised
from push_mpc.plan import Plan
from push_mpc.qp.steady_shift import steady_shift


@dataclass(frozen=True)
class Preview:
    """Transitions of one horizon step from every sample of a plan.

    Attributes:
        transition: A (n, 4, 4).
        effect: B (n, 4, m).
        drift: (n, 4, 1 + 3); column 0: motion of the model along the plan minus that of the
            plan; columns 1 to 3: its derivative by the disturbance, a model error as a twist per
            metre of travel.
        target: (n, 4 + m, 3) change of state and input that keeps the object on the path, as a
            derivative by the disturbance; see `steady_shift`.
        input: nominal input at the start of the step (n, m).
        contact: nominal p_y at the end of the step (n,) [m].
    """

    transition: Array
    effect: Array
    drift: Array
    target: Array
    input: Array
    contact: Array

    @classmethod
    def of(cls, plan: Plan, motion: Motion, stride: int, rates: Array | None = None) -> 'Preview':
        """Linearises a motion about a plan.

        Args:
            plan: of the horizon.
            motion: to linearise.
            stride: samples of one step.
            rates: of the state along the plan (n, 4), if they are known better than by `motion`.
        """
        rates = motion.rates(plan.state, plan.input) if rates is None else rates
        by_state, by_input = motion.linearised(plan.state, plan.input)
        by_twist = motion.disturbed(plan.state, plan.input)
        # the error of the plan acts like one more input that is always 1
        inputs = np.concatenate([by_input, _missed(plan, rates)[:, :, None], by_twist], axis=-1)
        transition, effect = discretised(by_state, inputs, stride, plan.period)
        index = np.arange(len(plan.state))
        ahead = np.minimum(index + stride, len(index) - 1)
        inputs_end = by_input.shape[-1]
        return cls(
            transition,
            effect[:, :, :inputs_end],
            effect[:, :, inputs_end:],
            steady_shift(by_state, by_input, by_twist),
            plan.input,
            plan.state[ahead, 3],
        )


def _missed(plan: Plan, rates: Array) -> Array:
    """Rates of the model at the nominal (n, 4) minus those of the plan."""
    return np.asarray(rates - np.gradient(plan.state, plan.period, axis=0))
