"""Quasi-static pushing through one point contact: the motion cone over a limit surface.

All motion is per metre of pusher travel, and so a function of the contact offset p_y and the push
direction beta alone: v = [sin(beta), cos(beta)] along the inward normal and the face.
Source: Mason 1986, Lynch et al. 1992; notation of Bauza, Hogan and Rodriguez 2018, section 3.
"""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from push_core.geometry import Array
from push_core.physics import point_contact
from push_core.physics.slider import Slider

GRAZING = 0.01
"""Smallest angle [rad] between face and push direction at which models are evaluated."""


class ContactMode(IntEnum):
    """Contact mode; the sign is that of the tip's slip along the face."""

    SLIDING_RIGHT = -1
    STICKING = 0
    SLIDING_LEFT = 1


def contact_jacobian(p_x: float, p_y: float) -> Array:
    """Matrix (2, 3) from the twist of the object to the velocity of its contact point."""
    return np.array([[1.0, 0.0, -p_y], [0.0, 1.0, p_x]])


@dataclass(frozen=True)
class MotionCone:
    """Motion of a slider that is pushed on its face x = p_x."""

    slider: Slider

    def twist_of_force(self, p_y: Array, force: Array) -> Array:
        """Force form: twist direction (n, 3) for contact forces (n, 2) [normal, tangential].

        Scaled such that the translation equals the force; the true scale follows from the speed.
        """
        normal, tangential = np.asarray(force).T
        p_x, c_squared = self.slider.p_x, self.slider.support_radius**2
        twist = point_contact.twist_of_force(p_x, np.asarray(p_y), c_squared, normal, tangential)
        return np.stack(twist, axis=-1)

    def force_of_velocity(self, p_y: Array, beta: Array) -> Array:
        """Velocity form: contact force (n, 2) for unit pushes, in the scale of the force form."""
        p_y, beta = np.asarray(p_y, dtype=float), np.asarray(beta, dtype=float)
        return self._solve(p_y, beta)[0]

    def mode(self, p_y: Array, beta: Array) -> Array:
        """Contact mode (n,) of unit pushes, values of `ContactMode`."""
        p_y, beta = np.asarray(p_y, dtype=float), np.asarray(beta, dtype=float)
        matrix, friction = self._mobility(p_y), self.slider.friction_pusher
        return np.asarray(point_contact.slip_sign(matrix, friction, np.sin(beta), np.cos(beta)))

    def evaluate(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """Displacement rates and their Jacobian.

        Args:
            p_y: contact offsets (n,) [m].
            beta: push directions (n,) [rad] in (0, pi).

        Returns:
            d[x_b, y_b, theta]/ds (n, 3) in the body frame [1, 1, rad/m], and its derivatives
            (n, 3, 2) with respect to [p_y, beta].
        """
        p_y, beta = np.asarray(p_y, dtype=float), np.asarray(beta, dtype=float)
        force, force_jacobian = self._solve(p_y, beta)
        mean = self.twist_of_force(p_y, force)
        jacobian = np.empty((p_y.size, 3, 2))
        for column in range(2):
            jacobian[:, :, column] = self.twist_of_force(p_y, force_jacobian[:, :, column])
        jacobian[:, 2, 0] -= force[:, 0] / self.slider.support_radius**2
        return mean, jacobian

    def _mobility(self, p_y: Array) -> point_contact.Mobility:
        return point_contact.mobility(self.slider.p_x, p_y, self.slider.support_radius**2)

    def _solve(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """Contact force (n, 2) and its derivatives (n, 2, 2) by [p_y, beta]."""
        mode = self.mode(p_y, beta)
        sticking = self._sticking(p_y, beta)
        sliding = self._sliding(p_y, beta, mode)
        sticks = mode == ContactMode.STICKING
        force = np.where(sticks[:, None], sticking[0], sliding[0])
        return force, np.where(sticks[:, None, None], sticking[1], sliding[1])

    def _sticking(self, p_y: Array, beta: Array) -> tuple[Array, Array]:
        """Force M^-1 v and its derivative, M df = dv - dM f."""
        matrix = self._mobility(p_y)
        v_n, v_t = np.sin(beta), np.cos(beta)

        def solve(normal: Array, tangential: Array) -> Array:
            return np.stack(point_contact.sticking_force(matrix, normal, tangential), axis=-1)

        force = solve(v_n, v_t)
        c_squared, p_x = self.slider.support_radius**2, self.slider.p_x
        dm_f_n = (2.0 * p_y * force[:, 0] - p_x * force[:, 1]) / c_squared
        dm_f_t = -p_x * force[:, 0] / c_squared
        return force, np.stack([solve(-dm_f_n, -dm_f_t), solve(v_t, -v_n)], axis=-1)

    def _sliding(self, p_y: Array, beta: Array, mode: Array) -> tuple[Array, Array]:
        """The force on the friction cone's edge, scaled to match the normal velocity."""
        friction = mode * self.slider.friction_pusher
        scale = point_contact.cone_edge(self._mobility(p_y), friction)[0]
        c_squared, p_x = self.slider.support_radius**2, self.slider.p_x
        scale_by_p_y = (2.0 * p_y - friction * p_x) / c_squared
        f_n = np.sin(beta) / scale
        f_n_jacobian = np.stack([-f_n * scale_by_p_y / scale, np.cos(beta) / scale], axis=-1)
        edge = np.stack([np.ones_like(f_n), friction], axis=-1)
        return f_n[:, None] * edge, edge[:, :, None] * f_n_jacobian[:, None, :]
