"""The QPs of one tick: what they need is loaded before the poses arrive, then they are solved."""

import time as clock
from pkgutil import resolve_name

import numpy as np
from push_core.common import InterruptsHeld
from push_core.geometry import Array, rotation, wrap_angle
from push_core.physics import Slider

from push_mpc.loop.modes import Mode
from push_mpc.loop.prepared_model import PreparedModel
from push_mpc.loop.tick import Tick
from push_mpc.plan import Plan
from push_mpc.qp import Move, PlannedStates, Problem, StagedPlan, Steering
from push_mpc.settings import CONTROLLERS, ControllerSettings
from push_mpc.table import Table

_RAISED = 0  # status of a solver that raised an exception
_STILL = np.zeros(2)


class Tracker:
    """Solves the QPs of the horizon that begins at a time of the plan.

    Attributes:
        steering: with the solvers.
        horizon_step: time between the states of the horizon [s].
    """

    def __init__(self, settings: ControllerSettings, slider: Slider, plan: Plan) -> None:
        self._slider = slider
        self.steering = made_steering(settings, slider, plan.speed)
        # OSQP has a handler of its own while it solves
        self._interrupts_held = InterruptsHeld()
        self._stride = horizon_stride(plan, settings)
        self._steps = self._stride * np.arange(settings.horizon_steps + 1)
        self._samples = self._steps.copy()
        self._loaded = ('', -1)
        self.horizon_step = self._stride * plan.period

    @property
    def problems(self) -> tuple[Problem, ...]:
        """The QPs of the latest tick."""
        return tuple(solver.problem for solver in self.steering.solvers)

    def staged(self, table: Table, plan: Plan, slider: Slider) -> StagedPlan:
        """What the QPs need along a plan; safe to call in another thread.

        Args:
            table: the model.
            plan: to track.
            slider: with the identified friction and support radius.
        """
        return self.steering.staged(table, plan, self._stride, slider)

    def use(self, model: PreparedModel) -> StagedPlan:
        """Steers with a model from now on; its plan with the speed limits in effect."""
        self.steering.take(model.slider)
        return self.steering.bounded(model.staged)

    def change(self, settings: ControllerSettings) -> None:
        """Uses other weights and speed limits; `use` has to follow."""
        self.steering.change(settings)

    def forget(self) -> None:
        """Lets the next tick depend on no earlier one."""
        self.steering.forget()

    def unload(self) -> int:
        """Lets the next `prepare` load everything; returns the sample that was loaded."""
        sample = self._loaded[1]
        self._loaded = ('', -1)
        return sample

    def prepare(self, model: PreparedModel, sample: int) -> None:
        """Loads the QP data of the horizon that starts at a sample, unless it is loaded."""
        if self._loaded == (model.model_id, sample):
            return
        # the horizon stays at the plan's last sample
        np.minimum(self._steps + sample, len(model.plan.state) - 1, out=self._samples)
        self.steering.prepare(model.staged, self._samples)
        self._loaded = (model.model_id, sample)

    def prepare_next(self, model: PreparedModel) -> None:
        """Loads the QP data of the sample after the one that is loaded."""
        self.prepare(model, self._loaded[1] + 1)

    def solve(
        self, model: PreparedModel, state: Array, time: float, disturbance: Array, sent: Array
    ) -> tuple[Tick, Move]:
        """Solves the QPs for a predicted state.

        Args:
            model: in use.
            state: when the command acts (4,) [m, m, rad, m].
            time: of the plan then [s].
            disturbance: model error, a twist per metre of travel (3,) [1, 1, rad/m].
            sent: last command in the world frame (2,) [m/s].

        Returns:
            The record of the solution, without a command; and the solution.
        """
        started = clock.perf_counter()
        reference, nominal = model.plan.at(time)
        deviation = state - reference
        deviation[2] = wrap_angle(deviation[2])
        self.prepare(model, round(max(time, 0.0) / model.plan.period))
        move = self._solved(model, state, deviation, time, disturbance, sent)
        tick = Tick(
            Mode.TRACKING,
            _STILL,
            predicted=state,
            reference=reference,
            input=move.velocity if move.usable else None,
            nominal_input=nominal,
            solve_ms=1e3 * (clock.perf_counter() - started),
            iterations=move.iterations,
            solver_status=move.status,
            planned=PlannedStates(model.plan, self._samples, move.states) if move.usable else None,
        )
        return tick, move

    def _solved(
        self,
        model: PreparedModel,
        state: Array,
        deviation: Array,
        time: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """The result of the steering; of one that raises, a move that cannot be used."""
        # a tip that is already past the end of the face must not make the QP infeasible
        widening = max(abs(state[3]) - 0.5 * self._slider.side, 0.0)
        sent_in_body = rotation(state[2]).T @ sent
        try:
            with self._interrupts_held:
                return self.steering.solve(
                    model.staged, state, deviation, time, widening, disturbance, sent_in_body
                )
        except Exception as error:  # noqa: BLE001  whatever it is, the tip must come to rest
            return Move(_STILL, _RAISED, 0, f'it raised {error!r}', np.empty((0, 4)))


def made_steering(settings: ControllerSettings, slider: Slider, speed: float) -> Steering:
    """The steering of the controller that the settings name, for a plan's speed [m/s]."""
    steering_class = resolve_name(CONTROLLERS[settings.controller].steering)
    made: Steering = steering_class(settings, slider, speed)
    return made


def horizon_stride(plan: Plan, settings: ControllerSettings) -> int:
    """Plan samples per horizon step, from `horizon_step` [s] or else `horizon_length` [m].

    At high speeds the controller's shortest horizon is longer than that length.
    """
    if settings.horizon_step > 0.0:
        return max(1, round(settings.horizon_step / plan.period))
    shortest = CONTROLLERS[settings.controller].shortest_horizon
    whole = max(settings.horizon_length / plan.speed, shortest)
    return max(1, round(whole / settings.horizon_steps / plan.period))
