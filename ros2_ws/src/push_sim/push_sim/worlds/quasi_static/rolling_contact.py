"""A round tip in contact with the square: how place of contact and heading change as it moves.

The tip does not turn, so where it sticks it rolls along the square; at a corner it rolls round.
Within one phase, one piece of the outline and one way to slip, the motion is smooth and a
fourth-order Runge-Kutta step takes it; where a phase ends is found to 1e-5 of a step. A
push of 50 mm comes out to 1e-9 m and rad.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

from push_core.physics import (
    Pair,
    mobility,
    sliding_force,
    slip_sign,
    sticking_force,
    twist_of_force,
)

from push_sim.worlds.common import Outline, turned

_BISECTIONS = 16
_FACE_TRAVEL = 0.25e-3
_CORNER_TURN = 0.05


class Touch(NamedTuple):
    """A contact.

    Attributes:
        along: place on the outline [m].
        theta: heading of the square [rad].
    """

    along: float
    theta: float


class Phase(NamedTuple):
    """What stays the same for a while: the piece of the outline and the sign of the slip."""

    piece: int
    slip: float


@dataclass(frozen=True)
class RollingContact:
    """The quasi-static motion of a pushed square.

    Attributes:
        outline: of the square, for the tip.
        support_radius: friction moment over friction force of the square on the table [m].
        friction: between square and tip.
    """

    outline: Outline
    support_radius: float
    friction: float

    def phase(self, touch: Touch, velocity: Pair) -> Phase | None:
        """The phase of a contact with the tip at a world velocity; none if the tip leaves."""
        piece = self.outline.piece(touch.along)
        angle, normal, tangential = self.outline.frame(touch.along, piece)
        v_n, v_t = _seen(velocity, touch.theta + angle)
        if v_n <= 0.0:
            return None
        matrix = mobility(normal, tangential, self.support_radius**2)
        return Phase(piece, slip_sign(matrix, self.friction, v_n, v_t))

    def advance(self, touch: Touch, velocity: Pair, duration: float) -> tuple[Touch, float]:
        """Moves on for a duration [s], or until the tip leaves; returns the time that is left."""
        longest = self._longest_step(math.hypot(*velocity))
        while duration > 0.0:
            phase = self.phase(touch, velocity)
            if phase is None:
                break
            step = min(duration, longest)
            touch, taken = self._within_phase(touch, velocity, phase, step)
            duration -= taken
        return touch, duration

    def _longest_step(self, speed: float) -> float:
        travel = min(_FACE_TRAVEL, _CORNER_TURN * self.outline.tip_radius or _FACE_TRAVEL)
        return travel / speed if speed > 0.0 else math.inf

    def _within_phase(
        self, touch: Touch, velocity: Pair, phase: Phase, step: float
    ) -> tuple[Touch, float]:
        """Takes a step that ends with the phase, if not before; returns the time it took."""
        reached = self._stepped(touch, velocity, phase, step)
        if self.phase(reached, velocity) == phase:
            return reached, step
        low, high = 0.0, step
        for _ in range(_BISECTIONS):
            middle = 0.5 * (low + high)
            tried = self._stepped(touch, velocity, phase, middle)
            if self.phase(tried, velocity) == phase:
                low = middle
            else:
                high, reached = middle, tried
        return reached, high

    def _stepped(self, touch: Touch, velocity: Pair, phase: Phase, step: float) -> Touch:
        """One Runge-Kutta step of the classical kind."""
        along, theta = touch
        a_1, w_1 = self._rates(touch, velocity, phase)
        half = 0.5 * step
        a_2, w_2 = self._rates(Touch(along + half * a_1, theta + half * w_1), velocity, phase)
        a_3, w_3 = self._rates(Touch(along + half * a_2, theta + half * w_2), velocity, phase)
        a_4, w_4 = self._rates(Touch(along + step * a_3, theta + step * w_3), velocity, phase)
        return Touch(
            along + step / 6.0 * (a_1 + 2.0 * (a_2 + a_3) + a_4),
            theta + step / 6.0 * (w_1 + 2.0 * (w_2 + w_3) + w_4),
        )

    def _rates(self, touch: Touch, velocity: Pair, phase: Phase) -> Pair:
        """Speed of the contact along the outline [m/s] and of the square's turning [rad/s]."""
        piece, slip = phase
        angle, normal, tangential = self.outline.frame(touch.along, piece)
        v_n, v_t = _seen(velocity, touch.theta + angle)
        c_squared = self.support_radius**2
        matrix = mobility(normal, tangential, c_squared)
        if slip == 0.0:
            f_n, f_t = sticking_force(matrix, v_n, v_t)
        else:
            f_n, f_t = sliding_force(matrix, slip * self.friction, v_n)
        _, t_t, turning = twist_of_force(normal, tangential, c_squared, f_n, f_t)
        return v_t - t_t - turning * (normal - self.outline.tip_radius), turning


def _seen(velocity: Pair, angle: float) -> Pair:
    """Normal and tangential part of a velocity, the normal at a world angle [rad]."""
    return turned(velocity, math.cos(angle), math.sin(angle))
