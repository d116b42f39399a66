"""Shift of the QP's target that keeps the object on its path under a constant disturbance."""

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array

from push_mpc.motion import Motion
from push_mpc.plan import Plan

# weights of the rates: 1 rad counts like 30 mm; the rate of p_y matters least
_WORTH = np.array([1.0, 1.0, 0.03, 0.1])
_EASE = np.array([0.1, 0.005])  # [rad], [m]; changes of theta and p_y that cost the same
_INPUT_EASE = 0.25  # of the nominal speed; a change of the input that costs the same
_DAMPING = 1e-4


def steady_shift(motion: Motion, plan: Plan) -> Array:
    """The smallest change of state and input that keeps the planned rates under a disturbance.

    The planned rates cannot always be kept exactly, since a contact that sticks or slides does not
    reach all four rates. Hence damped least squares.

    Args:
        motion: of object and contact.
        plan: n samples; its inputs are those of the motion, m of them.

    Returns:
        Derivative (n, 4 + m, 3) of the change of state and input by the disturbance; the position
        does not change.

    Raises:
        InputError: the model's displacement rates are implausibly large.
    """
    by_state, by_input = motion.linearised(plan.state, plan.input)
    by_twist = motion.disturbed(plan.state, plan.input)
    speed = by_twist[:, 2, 2]
    worth = _WORTH[:, None] / speed[:, None, None]
    strength = np.linalg.norm(_WORTH[:, None] * by_input, axis=1)
    input_ease = _INPUT_EASE * speed[:, None] / np.maximum(strength, 1e-9)
    ease = np.concatenate([np.tile(_EASE, (len(speed), 1)), input_ease], axis=-1)
    balance = worth * np.concatenate([by_state[:, :, 2:], by_input], axis=-1) * ease[:, None]
    turned = balance.swapaxes(1, 2)
    damped = balance @ turned + _DAMPING * np.eye(4)
    try:
        solved = np.linalg.solve(damped, worth * by_twist)
    except np.linalg.LinAlgError as error:
        raise InputError('the model returned implausibly large displacement rates') from error
    change = -ease[:, :, None] * (turned @ solved)
    return np.concatenate([np.zeros_like(change[:, :2]), change], axis=1)
