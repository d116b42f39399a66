"""Motion of slider and contact under a contact force, and its linearisation.

State [x, y, theta, p_y], input [f_n, f_t, slip] (Hogan and Rodriguez 2016): the twist is that of
the limit surface, t = grad H(J^T f), scaled as in the paper, where the magnitude of the force is
proportional to the speed. The slip is that of the tip along the face. In the paper it equals
d(p_y)/dt; a round tip that does not turn also rolls on the turning face, and
d(p_y)/dt = slip + omega * radius.
"""

from dataclasses import dataclass

import numpy as np
from push_core.geometry import Array
from push_core.physics import LimitSurface, Slider, contact_jacobian, point_contact

from push_mpc.motion.dynamics import contact_row, disturbed, to_rates
from push_mpc.motion.expansion import Expansion


@dataclass(frozen=True)
class ContactForce:
    """Motion of a slider under a force at its face; see `Motion`."""

    slider: Slider

    def rates(self, state: Array, inputs: Array) -> Array:
        """Time derivative (n, 4) of states (n, 4) under inputs (n, 3)."""
        twist = self._twist(state[:, 3], inputs)
        return to_rates(twist, inputs[:, 2] + self._rolled(twist), state[:, 2])

    def linearised(self, state: Array, inputs: Array) -> tuple[Array, Array]:
        """Jacobians of `rates`: by the state (n, 4, 4) and by the input (n, 4, 3)."""
        twist = self._twist(state[:, 3], inputs)
        cos, sin = np.cos(state[:, 2]), np.sin(state[:, 2])
        by_state, by_input = np.zeros((len(state), 4, 4)), np.zeros((len(state), 4, 3))
        by_state[:, 0, 2] = -sin * twist[:, 0] - cos * twist[:, 1]
        by_state[:, 1, 2] = cos * twist[:, 0] - sin * twist[:, 1]
        turned = np.zeros_like(twist)
        turned[:, 2] = -self._weights[2] * inputs[:, 0]
        by_state[:, :, 3] = to_rates(turned, self._rolled(turned), state[:, 2])
        for column in range(2):
            moved = self._twist(state[:, 3], np.tile(np.eye(3)[column], (len(state), 1)))
            by_input[:, :, column] = to_rates(moved, self._rolled(moved), state[:, 2])
        by_input[:, 3, 2] = 1.0
        return by_state, by_input

    def disturbed(self, state: Array, inputs: Array) -> Array:
        """Derivative (n, 4, 3) of `rates` by a model error (twist per metre of travel)."""
        velocity = self._twist(state[:, 3], inputs)
        along = velocity[:, 0] - state[:, 3] * velocity[:, 2]
        aside = velocity[:, 1] + self.slider.p_x * velocity[:, 2] + inputs[:, 2]
        return disturbed(np.hypot(along, aside), state[:, 2], self.slider.tip_x)

    def expand(self, state: Array, inputs: Array, into: Expansion) -> None:
        """See `Motion.expand`."""
        (f_n, f_t, slip), (w_x, w_y, w_turn) = inputs.T, self._weights
        p_x, p_y = self.slider.p_x, state[:, 3]
        speed, along, aside, turn = into.scratch
        twist = into.twist
        np.multiply(f_n, w_x, out=along)
        np.multiply(f_t, w_y, out=aside)
        twist[:, 0, 0], twist[:, 1, 0] = along, aside
        np.multiply(f_n, -w_turn, out=twist[:, 2, 1])
        np.multiply(twist[:, 2, 1], p_y, out=turn)
        np.multiply(f_t, w_turn * p_x, out=twist[:, 2, 0])
        twist[:, 2, 0] += turn
        twist[:, 0, 2], twist[:, 1, 3] = w_x, w_y
        np.multiply(p_y, -w_turn, out=twist[:, 2, 2])
        twist[:, 2, 3] = w_turn * p_x
        # the speed of the tip: that of the contact point, and the slip along the face
        turn[:] = twist[:, 2, 0]
        np.multiply(turn, p_y, out=speed)
        along -= speed
        np.multiply(turn, p_x, out=speed)
        aside += speed
        aside += slip
        np.hypot(along, aside, out=speed)
        into.set_error(speed)
        rolling = np.array([0.0, 0.0, self.slider.tip_radius])
        into.turn(state[:, 2], rolling, contact_row(self.slider.tip_x))
        into.rates[:, 3] += slip
        into.by_input[:, 3, 2] += 1.0

    def tip_velocity(self, p_y: float, force: Array) -> Array:
        """Tip velocity (2,) [m/s] in the body frame that produces an input (3,)."""
        jacobian = contact_jacobian(self.slider.p_x, p_y)
        velocity = jacobian @ (self._weights * (jacobian.T @ force[:2]))
        velocity[1] += force[2]
        return np.asarray(velocity)

    def normal_force(self, p_y: Array, speed: float) -> Array:
        """Forces f_n (n,) that alone move contact points at p_y (n,) inwards at a speed [m/s]."""
        slider = self.slider
        mobility = point_contact.mobility(slider.p_x, p_y, slider.support_radius**2)
        return np.asarray(speed / (self._weights[0] * mobility[0]))

    def of_velocity(self, p_y: Array, velocity: Array) -> Array:
        """Inputs (n, 3) that result from tip velocities (n, 2) [m/s] at offsets p_y (n,) [m]."""
        each = zip(p_y.tolist(), *velocity.T.tolist(), strict=True)
        return np.array([self.input_of(*one) for one in each])

    def input_of(self, p_y: float, v_n: float, v_t: float) -> Array:
        """Input (3,) that results from one tip velocity [m/s] at an offset p_y [m]."""
        slider = self.slider
        matrix = point_contact.mobility(slider.p_x, p_y, slider.support_radius**2)
        side = point_contact.slip_sign(matrix, slider.friction_pusher, v_n, v_t)
        if side:
            friction = side * slider.friction_pusher
            normal, tangential = point_contact.sliding_force(matrix, friction, v_n)
        else:
            normal, tangential = point_contact.sticking_force(matrix, v_n, v_t)
        _, along, tt = matrix
        slip = v_t - along * normal - tt * tangential
        scale = 1.0 / self._weights[0]
        return np.array([normal * scale, tangential * scale, slip])

    def of_speeds(self, speeds: Array) -> Array:
        """Inputs (n, 3) from speeds (n, 4): a force is given by the translation speed it causes.

        Args:
            speeds: of f_n, of f_t, of the slip to the left and of that to the right [m/s].
        """
        forces = speeds[:, :2] / self._weights[0]
        return np.column_stack([forces, speeds[:, 2] - speeds[:, 3]])

    @property
    def _weights(self) -> Array:
        return LimitSurface.of(self.slider).weights

    def _rolled(self, twist: Array) -> Array:
        """How fast a round tip rolls along the face (n,) [m/s]."""
        return np.asarray(self.slider.tip_radius * twist[:, 2])

    def _twist(self, p_y: Array, inputs: Array) -> Array:
        """Body twist (n, 3)."""
        f_n, f_t = inputs[:, 0], inputs[:, 1]
        wrench = np.stack([f_n, f_t, self.slider.p_x * f_t - p_y * f_n], axis=-1)
        return np.asarray(self._weights * wrench)
