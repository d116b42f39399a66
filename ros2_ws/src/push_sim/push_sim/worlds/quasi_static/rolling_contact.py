"""Rolling contact of round tip and square: integrates contact point and heading.

The tip does not rotate, so a sticking tip rolls along the square, also around corners. Within a
phase, one piece of the outline and one sign of slip, the motion is smooth: it is integrated by
fourth-order Runge-Kutta steps, and the end of a phase is located to 1e-5 of a step. The end of a
50 mm push is accurate to 1e-9 m and rad.
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
        along: arc length of the contact on the outline [m].
        theta: heading of the square [rad].
    """

    along: float
    theta: float


class Phase(NamedTuple):
    """Piece of the outline and sign of the slip."""

    piece: int
    slip: float


@dataclass(frozen=True)
class RollingContact:
    """The quasi-static motion of a pushed square.

    Attributes:
        outline: outline of the square for the tip.
        support_radius: friction moment divided by friction force on the table [m].
        friction: friction coefficient of square and tip.
    """

    outline: Outline
    support_radius: float
    friction: float

    def phase(self, touch: Touch, velocity: Pair) -> Phase | None:
        """The phase of a contact with a world velocity of the tip; None if the tip leaves."""
        piece = self.outline.piece(touch.along)
        angle, normal, tangential = self.outline.frame(touch.along, piece)
        v_n, v_t = _components(velocity, touch.theta + angle)
        if v_n <= 0.0:
            return None
        matrix = mobility(normal, tangential, self.support_radius**2)
        return Phase(piece, slip_sign(matrix, self.friction, v_n, v_t))

    def advance(self, touch: Touch, velocity: Pair, duration: float) -> tuple[Touch, float]:
        """Integrates a duration [s] or until the tip leaves; returns the remaining time [s]."""
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
        """A step that ends at the latest with the phase; returns its duration [s]."""
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
        """One step of the classical Runge-Kutta method."""
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
        """Rates of arc length [m/s] and heading [rad/s]."""
        piece, slip = phase
        angle, normal, tangential = self.outline.frame(touch.along, piece)
        v_n, v_t = _components(velocity, touch.theta + angle)
        c_squared = self.support_radius**2
        matrix = mobility(normal, tangential, c_squared)
        if slip == 0.0:
            f_n, f_t = sticking_force(matrix, v_n, v_t)
        else:
            f_n, f_t = sliding_force(matrix, slip * self.friction, v_n)
        _, t_t, turn_rate = twist_of_force(normal, tangential, c_squared, f_n, f_t)
        return v_t - t_t - turn_rate * (normal - self.outline.tip_radius), turn_rate


def _components(velocity: Pair, angle: float) -> Pair:
    """Normal and tangential component of a velocity; the normal has a world angle [rad]."""
    return turned(velocity, math.cos(angle), math.sin(angle))
