"""Interface of the controllers: from the deviation of a tick to a tip velocity, by one QP or more.

There are two, those of the paper: `VelocitySteering` optimises the velocity of the tip, with a
model of the object's displacement. `ForceSteering` (the Family of Modes) optimises contact force
and contact mode, with the limit surface of the object.
"""

from dataclasses import dataclass, replace
from typing import Protocol

from push_core.geometry import Array
from push_core.physics import Slider

from push_mpc.motion import TravelModel
from push_mpc.plan import Placement, Plan
from push_mpc.qp.stages import Stages
from push_mpc.qp.tracking_qp import TrackingQP
from push_mpc.settings import ControllerSettings


@dataclass(frozen=True)
class LinearisedPlan:
    """The QP data along one plan; computed once for each plan and model.

    Attributes:
        plan: its inputs are those of the QPs: tip velocities, or contact forces and slip.
        contact: nominal p_y at the end of the stage that begins at each sample (n,) [m].
        stages: linearised stages along the plan, for each QP of the controller.
    """

    plan: Plan
    contact: Array
    stages: tuple[Stages, ...]

    def placed(self, placement: Placement) -> 'LinearisedPlan':
        """The same along the plan moved; the equations of motion do not depend on the place."""
        stages = tuple(each.turned(placement.turn) for each in self.stages)
        return replace(self, plan=placement.of(self.plan), stages=stages)


@dataclass(frozen=True)
class Move:
    """Result of one tick.

    Attributes:
        velocity: of the tip in the body frame (2,) [m/s].
        status: of the solver, 1 = solved.
        iterations: of the solver, summed over the QPs.
        fault: why the velocity may not be sent, else empty.
        states: planned deviations of the states, see `Solution`.
    """

    velocity: Array
    status: int
    iterations: int
    fault: str
    states: Array

    @property
    def usable(self) -> bool:
        """Whether the velocity may be sent."""
        return not self.fault


class Steering(Protocol):
    """Solves the QPs of a tick.

    Attributes:
        solvers: one for each QP.
    """

    solvers: tuple[TrackingQP, ...]

    def linearised(self, model: TravelModel, plan: Plan, stride: int) -> LinearisedPlan:
        """Linearises a model along a plan, in stages of `stride` samples.

        Does not touch the solvers, so it may run in another thread.
        """

    def of_slider(self, slider: Slider) -> 'Steering':
        """The same for another friction and support radius; itself if it does not use them."""

    def change(self, settings: ControllerSettings) -> None:
        """Uses other weights and speed limits; see `bounded` for plans that exist."""

    def bounded(self, linearised: LinearisedPlan) -> LinearisedPlan:
        """A linearised plan with the speed limits in effect."""

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
        """
