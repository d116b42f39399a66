<<<<<<< HEAD
"""Interface of the controllers: from the deviation of a tick to a tip velocity, by one QP or more.

There are two, those of the paper: `VelocitySteering` optimises the velocity of the tip, with a
model of the object's displacement. `ForceSteering` (the Family of Modes) optimises contact force
and contact mode, with the limit surface of the object.
=======
"""The interface between the controller and the QPs of one tick.

The paper has two formulations: `VelocitySteering` optimises the tip velocity with a model of the
object's displacement, `ForceSteering` the contact force and mode with the limit surface.
>>>>>>> f004edb (Call QPs so throughout push_mpc, and say what their data are)
"""

from dataclasses import dataclass
from typing import Protocol

from push_core.geometry import Array

from push_mpc.motion import TravelModel
from push_mpc.plan import Plan
from push_mpc.qp.stages import Stages
from push_mpc.qp.tracking_qp import TrackingQP


@dataclass(frozen=True)
<<<<<<< HEAD
class LinearisedPlan:
    """The QP data along one plan; computed once for each plan and model.

    Attributes:
        plan: its inputs are those of the QPs: tip velocities, or contact forces and slip.
        stages: linearised stages along the plan, for each QP of the controller.
=======
class PreparedQps:
    """The data of the QPs along one plan.

    Attributes:
        plan: its inputs are those that the QPs optimise.
        stages: of each QP.
>>>>>>> f004edb (Call QPs so throughout push_mpc, and say what their data are)
    """

    plan: Plan
    stages: tuple[Stages, ...]


@dataclass(frozen=True)
<<<<<<< HEAD
class Move:
    """Result of one tick.
=======
class SteeringResult:
    """The result of the QPs of one tick.
>>>>>>> f004edb (Call QPs so throughout push_mpc, and say what their data are)

    Attributes:
        velocity: of the tip in the body frame (2,) [m/s].
        status: of the solver, 1 = solved.
        iterations: of the solver, summed over the QPs.
        usable: whether the velocity may be sent.
        states: planned deviations of the states, see `Solution`.
    """

    velocity: Array
    status: int
    iterations: int
    usable: bool
    states: Array


class Steering(Protocol):
<<<<<<< HEAD
    """Solves the QPs of a tick.

    Attributes:
        solvers: one for each QP.
=======
    """The QPs of one tick.

    Attributes:
        solvers: one per QP.
>>>>>>> f004edb (Call QPs so throughout push_mpc, and say what their data are)
    """

    solvers: tuple[TrackingQP, ...]

<<<<<<< HEAD
    def linearised(self, model: TravelModel, plan: Plan, stride: int) -> LinearisedPlan:
        """Linearises a model along a plan, in stages of `stride` samples.

        Does not touch the solvers, so it may run in another thread.
        """

    def prepare(self, linearised: LinearisedPlan, window: Array) -> None:
        """Loads the stages (N,) of the next horizon into the solvers, before the poses arrive."""

    def solve(
        self,
        linearised: LinearisedPlan,
        state: Array,
        deviation: Array,
        time: float,
        widening: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """Solves the prepared QPs.

        Args:
            linearised: the plan of which `prepare` loaded a window.
            state: predicted state (4,) at the time when the command acts.
            deviation: of that state from the nominal (4,) [m, m, rad, m].
            time: of the plan [s].
            widening: added to the bounds of p_y on both sides [m].
            disturbance: model error, a twist per metre of travel (3,) [1, 1, rad/m].
            sent: last command, in the body frame (2,) [m/s].
=======
    def prepared_qps(self, model: TravelModel, plan: Plan, stride: int) -> PreparedQps:
        """Linearises along a plan, in stages of `stride` samples; needs no solver."""

    def prepare(self, qps: PreparedQps, window: Array) -> None:
        """Loads the stages of a window (N,), which do not depend on the state."""

    def solve(
        self,
        qps: PreparedQps,
        state: Array,
        deviation: Array,
        time: float,
        face_slack: float,
        disturbance: Array,
        sent: Array,
    ) -> SteeringResult:
        """Solves the prepared QPs.

        Args:
            qps: the ones that were prepared.
            state: at the time at which the velocity will act (4,) [m, m, rad, m].
            deviation: from the nominal (4,) [m, m, rad, m].
            time: of the plan [s].
            face_slack: by how much the bounds of p_y are widened [m].
            disturbance: estimated model error, twist per metre of travel (3,) [1, 1, rad/m].
            sent: last command in the body frame (2,) [m/s].
>>>>>>> f004edb (Call QPs so throughout push_mpc, and say what their data are)
        """
