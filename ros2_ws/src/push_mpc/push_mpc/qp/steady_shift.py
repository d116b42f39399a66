"""Shift of the QP's target that keeps the object on its path under a constant disturbance."""

import numpy as np
from push_core.common import InputError
from push_core.geometry import Array

# weights of the rates: 1 rad counts like 30 mm; the rate of p_y matters least
_WORTH = np.array([1.0, 1.0, 0.03, 0.1])
_EASE = np.array([0.1, 0.005])  # [rad], [m]; changes of theta and p_y that cost the same
_INPUT_EASE = 0.25  # of the nominal speed; a change of the input that costs the same
_DAMPING = 1e-4


def steady_shift(by_state: Array, by_input: Array, by_twist: Array) -> Array:
    """The smallest change of state and input that keeps the planned rates under a disturbance.

    The planned rates cannot always be kept exactly, since a contact that sticks or slides does not
    reach all four rates. Hence damped least squares.

    Args:
        by_state: derivative of the rates by the state (n, 4, 4).
        by_input: by the input (n, 4, m).
        by_twist: by the disturbance, a twist per metre of travel (n, 4, 3).

    Returns:
        Derivative (n, 4 + m, 3) of the change of state and input by the disturbance; the position
        does not change.

    Raises:
        InputError: the model's displacement rates are implausibly large.
    """
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
