"""Interface of the controllers: from the deviation of a tick to a tip velocity, by one QP or more.

There are two, those of the paper: `VelocitySteering` optimises the velocity of the tip, with a
model of the object's displacement. `ForceSteering` (the Family of Modes) optimises contact force
and contact mode, with the limit surface of the object.
"""

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from push_core.geometry import Array, rotation
from push_core.physics import Slider

from push_mpc.motion import Motion, TabulatedModel
from push_mpc.plan import Placement, Plan
from push_mpc.qp.stages import Stages
from push_mpc.qp.tracking_qp import TrackingQP
from push_mpc.settings import ControllerSettings


@dataclass(frozen=True)
class StagedPlan:
    """The QP data along one plan; computed once for each plan and model.

    Attributes:
        plan: its inputs are those of the QPs: tip velocities, or contact forces and slip.
        motion: equations of motion of the QPs.
        stride: samples of the plan in a step of the horizon.
        contact: nominal p_y at the end of the step that begins at each sample (n,) [m].
        mean_input: of the plan over that step (n, m).
        excess: rates of the state along the plan beyond those of `motion`, mean over the step,
            where a model knows them better (n, 4).
        stages: targets and bounds along the plan, for each QP of the controller.
    """

    plan: Plan
    motion: Motion
    stride: int
    contact: Array
    mean_input: Array
    excess: Array
    stages: tuple[Stages, ...]

    @property
    def step(self) -> float:
        """Duration of a step of the horizon [s]."""
        return self.stride * self.plan.period

    def placed(self, placement: Placement) -> 'StagedPlan':
        """The same along the plan moved."""
        excess = self.excess.copy()
        excess[:, :2] = excess[:, :2] @ rotation(placement.turn).T
        return replace(self, plan=placement.of(self.plan), excess=excess)


def mean_over_steps(values: Array, stride: int) -> Array:
    """Mean of samples (n, m) over the step of `stride` samples after each; the last one is held.

    The trapezoidal rule.
    """
    samples = np.arange(len(values))[:, None] + np.arange(stride + 1)
    held = values[np.minimum(samples, len(values) - 1)]
    return np.asarray((held[:, 1:] + held[:, :-1]).mean(axis=1) * 0.5)


def contact_after(plan: Plan, stride: int) -> Array:
    """p_y (n,) [m] of the plan at the end of the step after each sample."""
    ahead = np.minimum(np.arange(len(plan.state)) + stride, len(plan.state) - 1)
    return np.asarray(plan.state[ahead, 3])


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

    def staged(self, model: TabulatedModel, plan: Plan, stride: int, slider: Slider) -> StagedPlan:
        """Computes what the QPs need along a plan.

        Does not touch the solvers, so it may run in another thread.

        Args:
            model: of the displacement.
            plan: along which.
            stride: samples in a step of the horizon.
            slider: whose friction and support radius the QPs take, if they use them.
        """

    def take(self, slider: Slider) -> None:
        """Uses another friction and support radius from the next `prepare` on; builds nothing."""

    def change(self, settings: ControllerSettings) -> None:
        """Uses other weights and speed limits; see `bounded` for plans that exist."""

    def bounded(self, staged: StagedPlan) -> StagedPlan:
        """A plan with the speed limits in effect."""

    def prepare(self, staged: StagedPlan, samples: Array) -> None:
        """Prepares the solvers for the next horizon, before the poses arrive.

        Linearises the motion along the last solution.

        Args:
            staged: the plan.
            samples: of the plan, at the ends of the steps of the horizon (N + 1,).
        """

    def forget(self) -> None:
        """Lets the next tick depend on no earlier one."""

    def solve(
        self,
        staged: StagedPlan,
        state: Array,
        deviation: Array,
        time: float,
        widening: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """Solves the prepared QPs.

        Args:
            staged: the plan for which `prepare` was called.
            state: predicted state (4,) at the time when the command acts.
            deviation: of that state from the nominal (4,) [m, m, rad, m].
            time: of the plan [s].
            widening: added to the bounds of p_y on both sides [m].
            disturbance: model error, a twist per metre of travel (3,) [1, 1, rad/m].
            sent: last command, in the body frame (2,) [m/s].
        """
