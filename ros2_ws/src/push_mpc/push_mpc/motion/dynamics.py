"""Motion of slider and contact, and its linearisation, for any model of [p_y, beta].

State [x, y, theta, p_y], input [v_n, v_t] in the body frame (Bauza et al. 2018, section 4). The
contact offset is that of the tip's centre: d(p_y)/dt = v_t - (t_y + omega * tip_x), which is the
paper's [v_p - J t] for a point and holds for a round tip as well.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from push_core.geometry import Array

from push_mpc.motion.expansion import Expansion

_SLOWEST = 1e-9  # [m/s]; a tip at rest has no direction


class TravelModel(Protocol):
    """Displacement rates of the object per metre of pusher travel."""

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """Rates (n, 3) [1, 1, rad/m] in the body frame and Jacobian (n, 3, 2) by [p_y, beta]."""


class TabulatedModel(TravelModel, Protocol):
    """A model that is evaluated in every tick."""

    def lookup(self, points: int) -> TravelModel:
        """The model for always as many points; it allocates nothing to evaluate them."""


class Motion(Protocol):
    """Motion of the state [x, y, theta, p_y] under inputs (n, m)."""

    def rates(self, state: Array, inputs: Array) -> Array:
        """Time derivative (n, 4) of states (n, 4) under inputs (n, m)."""

    def linearised(self, state: Array, inputs: Array) -> tuple[Array, Array]:
        """Jacobians of `rates`: by the state (n, 4, 4) and by the input (n, 4, m)."""

    def disturbed(self, state: Array, inputs: Array) -> Array:
        """Derivative (n, 4, 3) of `rates` by a model error (twist per metre of travel)."""

    def expand(self, state: Array, inputs: Array, into: Expansion) -> None:
        """All of the above, into arrays that exist."""


@dataclass(frozen=True)
class TravelMotion:
    """Motion under a moving tip, inputs [v_n, v_t].

    Attributes:
        model: of the object.
        tip_x: body-frame x [m] of the tip's centre.
        sideways_response: factor on the derivative of the object's sideways velocity by v_t in
            `expand`.
    """

    model: TravelModel
    tip_x: float
    sideways_response: float = 1.0

    def rates(self, state: Array, inputs: Array) -> Array:
        """Time derivative (n, 4) of states (n, 4) under inputs (n, 2)."""
        return rates(self.model, state, inputs, self.tip_x)

    def linearised(self, state: Array, inputs: Array) -> tuple[Array, Array]:
        """Jacobians of `rates`: by the state (n, 4, 4) and by the input (n, 4, 2)."""
        return linearised(self.model, state, inputs, self.tip_x)

    def disturbed(self, state: Array, inputs: Array) -> Array:
        """Derivative (n, 4, 3) of `rates` by a model error (twist per metre of travel)."""
        return disturbed(np.hypot(*inputs.T), state[:, 2], self.tip_x)

    def expand(self, state: Array, inputs: Array, into: Expansion) -> None:
        """See `Motion.expand`; allocates what its model allocates."""
        v_n, v_t = inputs.T
        speed, ahead, aside, beta = into.scratch
        np.hypot(v_n, v_t, out=speed)
        np.maximum(speed, _SLOWEST, out=speed)
        np.divide(v_n, speed, out=ahead)
        np.divide(v_t, speed, out=aside)
        np.arctan2(v_n, v_t, out=beta)
        rate, jacobian = self.model.evaluate(state[:, 3], beta)
        by_p_y, by_beta = jacobian[:, :, 0], jacobian[:, :, 1]
        np.multiply(rate, speed[:, None], out=into.twist[:, :, 0])
        np.multiply(by_p_y, speed[:, None], out=into.twist[:, :, 1])
        # d(speed) = [ahead, aside] dv and speed d(beta) = [aside, -ahead] dv
        into.combine(rate, ahead, by_beta, aside, into.twist[:, :, 2])
        np.negative(ahead, out=ahead)
        into.combine(rate, aside, by_beta, ahead, into.twist[:, :, 3])
        into.twist[:, 1, 3] *= self.sideways_response
        into.set_error(speed)
        row = contact_row(self.tip_x)
        into.turn(state[:, 2], row, row)
        into.rates[:, 3] += v_t
        into.by_input[:, 3, 1] += 1.0


def rates(model: TravelModel, state: Array, inputs: Array, tip_x: float) -> Array:
    """Time derivative (n, 4) of states (n, 4) under inputs (n, 2)."""
    twist = _twist(model, state, inputs)[0]
    return to_rates(twist, inputs[:, 1] + _contact(twist, tip_x), state[:, 2])


def linearised(
    model: TravelModel, state: Array, inputs: Array, tip_x: float
) -> tuple[Array, Array]:
    """Jacobians of `rates`: by the state (n, 4, 4) and by the input (n, 4, 2)."""
    twist, by_contact, by_input = _twist(model, state, inputs)
    cos, sin = np.cos(state[:, 2]), np.sin(state[:, 2])
    by_state = np.zeros((len(state), 4, 4))
    by_state[:, 0, 2] = -sin * twist[:, 0] - cos * twist[:, 1]
    by_state[:, 1, 2] = cos * twist[:, 0] - sin * twist[:, 1]
    by_state[:, :, 3] = to_rates(by_contact, _contact(by_contact, tip_x), state[:, 2])
    by_inputs = np.stack(
        [
            to_rates(moved, _contact(moved, tip_x), state[:, 2])
            for moved in np.moveaxis(by_input, 2, 0)
        ],
        axis=-1,
    )
    by_inputs[:, 3, 1] += 1.0
    return by_state, by_inputs


def disturbed(speed: Array, heading: Array, tip_x: float) -> Array:
    """Derivative (n, 4, 3) of the rates by a model error (twist per metre of travel).

    Args:
        speed: of the tip (n,) [m/s].
        heading: of the object (n,) [rad].
        tip_x: body-frame x [m] of the tip's centre.
    """
    twists = [speed[:, None] * unit for unit in np.eye(3)]
    columns = [to_rates(twist, _contact(twist, tip_x), heading) for twist in twists]
    return np.stack(columns, axis=-1)


def to_rates(twist: Array, contact: Array, heading: Array) -> Array:
    """Rates (n, 4) of the state for body twists (n, 3), rates of p_y (n,) and headings (n,)."""
    cos, sin = np.cos(heading), np.sin(heading)
    x = cos * twist[:, 0] - sin * twist[:, 1]
    y = sin * twist[:, 0] + cos * twist[:, 1]
    return np.stack([x, y, twist[:, 2], contact], axis=-1)


def contact_row(tip_x: float) -> Array:
    """Rate of p_y for each part of a twist (3,), for a tip at rest."""
    return np.array([0.0, -1.0, -tip_x])


def _contact(twist: Array, tip_x: float) -> Array:
    """Rate of p_y (n,) for a tip at rest."""
    return np.asarray(-twist[:, 1] - tip_x * twist[:, 2])


def _twist(model: TravelModel, state: Array, inputs: Array) -> tuple[Array, Array, Array]:
    """Body twist (n, 3), its derivative by p_y (n, 3) and by the input (n, 3, 2)."""
    v_n, v_t = inputs.T
    speed = np.maximum(np.hypot(v_n, v_t), _SLOWEST)
    rate, jacobian = model.evaluate(state[:, 3], np.arctan2(v_n, v_t))
    speed_by_input = inputs / speed[:, None]
    beta_by_input = np.stack([v_t, -v_n], axis=-1) / speed[:, None]
    by_input = (
        rate[:, :, None] * speed_by_input[:, None, :]
        + jacobian[:, :, 1, None] * beta_by_input[:, None, :]
    )
    return speed[:, None] * rate, speed[:, None] * jacobian[:, :, 0], by_input
