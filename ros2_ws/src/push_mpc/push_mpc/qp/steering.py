"""What a controller steers by: the programs of one tick, behind one seam.

There are two, those of the paper: `VelocitySteering` chooses the tip's velocity by a model of the
object's displacement, `ForceSteering` the contact's force and mode by its limit surface.
"""

from dataclasses import dataclass
from typing import Protocol

from push_core.geometry import Array

from push_mpc.motion import TravelModel
from push_mpc.plan import Plan
from push_mpc.qp.stages import Stages
from push_mpc.qp.tracking_qp import TrackingQP


@dataclass(frozen=True)
class Programs:
    """What the solvers are given along one plan.

    Attributes:
        plan: with the inputs that the programs choose.
        stages: of each program.
    """

    plan: Plan
    stages: tuple[Stages, ...]


@dataclass(frozen=True)
class Move:
    """What the programs of one tick found.

    Attributes:
        velocity: of the tip in the body frame (2,) [m/s].
        status: of the solver, 1 = solved.
        iterations: that it took, of all programs.
        usable: whether the velocity may be sent.
        states: planned deviations of the states, see `Solution`.
    """

    velocity: Array
    status: int
    iterations: int
    usable: bool
    states: Array


class Steering(Protocol):
    """The programs of one tick.

    Attributes:
        solvers: of each program.
    """

    solvers: tuple[TrackingQP, ...]

    def programs(self, model: TravelModel, plan: Plan, stride: int) -> Programs:
        """The programs about a plan, in stages of `stride` samples; needs no solver."""

    def prepare(self, programs: Programs, window: Array) -> None:
        """Puts in what is known before the state is, for a window (N,) of the stages."""

    def solve(
        self,
        programs: Programs,
        state: Array,
        deviation: Array,
        time: float,
        opening: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """Solves the prepared programs.

        Args:
            programs: those that were prepared.
            state: where the tip's velocity will act (4,).
            deviation: from the nominal (4,) [m, m, rad, m].
            time: of the plan [s].
            opening: by how much the bounds of p_y are wider than prepared [m].
            disturbance: twist beside the model's for each metre of travel (3,).
            sent: velocity of the tip that was sent last, in the body frame (2,) [m/s].
        """
