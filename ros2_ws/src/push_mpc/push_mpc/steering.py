"""What a controller steers by: the programs of one tick, behind one seam.

There are two, those of the paper: `VelocitySteering` chooses the tip's velocity by a model of the
object's displacement, `ForceSteering` the contact's force and mode by its limit surface.
"""

from dataclasses import dataclass
from typing import Protocol

from push_core.frames import Array

from push_mpc.dynamics import TravelModel
from push_mpc.stages import Stages


@dataclass(frozen=True)
class Move:
    """What the programs of one tick found.

    Attributes:
        velocity: of the tip in the body frame (2,) [m/s].
        status: of the solver, 1 = solved.
        iterations: that it took, of all programs.
        usable: whether the velocity may be sent.
    """

    velocity: Array
    status: int
    iterations: int
    usable: bool


class Steering(Protocol):
    """The programs of one tick, about one plan."""

    def stages(self, model: TravelModel, stride: int) -> tuple[Stages, ...]:
        """The stages of each program, `stride` samples of the plan long; needs no solver."""

    def prepare(self, stages: tuple[Stages, ...], window: Array) -> None:
        """Puts in what is known before the state is, for a window (N,) of the stages."""

    def solve(self, state: Array, deviation: Array, time: float, opening: float) -> Move:
        """Solves the prepared programs.

        Args:
            state: where the tip's velocity will act (4,).
            deviation: from the nominal (4,) [m, m, rad, m].
            time: of the plan [s].
            opening: by how much the bounds of p_y are wider than prepared [m].
        """
