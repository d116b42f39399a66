"""Rates of the state and their first derivatives at many points, in arrays that are made once.

Every column is a body twist, turned into the world, and the rate of p_y that comes with it: for
the motion itself, its derivative by p_y, by each input, and by each part of a model error.
"""

import numpy as np
from push_core.geometry import Array

BY_TWIST = 3
"""Parts of a model error, a twist per metre of travel."""


class Expansion:
    """First-order expansion of a motion at n points; valid until the next one is computed.

    Attributes:
        twist: body twists (n, 3, 2 + m + 3) that a motion fills in: its own, then the derivatives
            by p_y, by the inputs and by the model error.
        rates: of the state (n, 4).
        by_heading: derivative of `rates` by theta (n, 4).
        by_contact: by p_y (n, 4).
        by_input: by the inputs (n, 4, m).
        by_twist: by the model error (n, 4, 3).
        scratch: for the motion that fills in the twists, (4, n).
    """

    def __init__(self, points: int, inputs: int) -> None:
        """Makes the arrays for n points and m inputs."""
        columns = 2 + inputs + BY_TWIST
        self.twist = np.zeros((points, 3, columns))
        self.by_heading = np.zeros((points, 4))
        self._world = np.zeros((points, 4, columns))
        self._frame = np.zeros((points, 4, 3))
        self._frame[:, 2, 2] = 1.0
        self.scratch = np.zeros((4, points))
        self._product = np.zeros((points, 3))
        self._turning = np.zeros((points, BY_TWIST))
        self.rates, self.by_contact = self._world[:, :, 0], self._world[:, :, 1]
        self.by_input = self._world[:, :, 2 : 2 + inputs]
        self.by_twist = self._world[:, :, 2 + inputs :]

    def combine(self, one: Array, by_one: Array, two: Array, by_two: Array, out: Array) -> None:
        """Writes one (n, 3) times by_one (n,) plus two (n, 3) times by_two (n,)."""
        np.multiply(one, by_one[:, None], out=out)
        np.multiply(two, by_two[:, None], out=self._product)
        out += self._product

    def set_error(self, speed: Array) -> None:
        """Fills in the twists of the model error for speeds of the tip (n,) [m/s]."""
        for part in range(BY_TWIST):
            self.twist[:, part, part - BY_TWIST] = speed

    def turn(self, heading: Array, contact: Array, error_contact: Array) -> None:
        """Computes everything from the twists.

        Args:
            heading: of the object (n,) [rad].
            contact: rate of p_y for each part of a twist (3,), whatever else moves the tip.
            error_contact: the same for the parts of the model error (3,).
        """
        frame = self._frame
        np.cos(heading, out=frame[:, 0, 0])
        np.sin(heading, out=frame[:, 1, 0])
        np.negative(frame[:, 1, 0], out=frame[:, 0, 1])
        frame[:, 1, 1] = frame[:, 0, 0]
        frame[:, 3] = contact
        np.matmul(frame, self.twist, out=self._world)
        # the model error has the speed on its diagonal
        self._turning[:] = error_contact
        np.multiply(self._turning, self.twist[:, 2, -1:], out=self.by_twist[:, 3])
        np.negative(self.rates[:, 1], out=self.by_heading[:, 0])
        self.by_heading[:, 1] = self.rates[:, 0]
