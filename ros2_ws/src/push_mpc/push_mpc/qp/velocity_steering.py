"""The data-driven controller: one QP over the tip's velocity [v_n, v_t].

Works with any model of the object's displacement. Source: Bauza, Hogan and Rodriguez 2018,
section 4.
"""

from dataclasses import replace

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

from push_mpc.motion import TabulatedModel, TravelMotion
from push_mpc.plan import Plan
from push_mpc.qp.iteration import RealTimeIteration
from push_mpc.qp.stages import InputSpace, Stages
from push_mpc.qp.steady_shift import steady_shift
from push_mpc.qp.steering import Move, StagedPlan, contact_after, mean_over_steps
from push_mpc.qp.tracking_qp import QPWeights, TrackingQP
from push_mpc.settings import ControllerSettings, change_share

SPACE = InputSpace(np.full(2, 1e-2), np.eye(2), np.full(2, 1e-2), ('v_n [m/s]', 'v_t [m/s]'))


class VelocitySteering:
    """See `Steering`."""

    solvers: tuple[TrackingQP, ...]

    def __init__(self, settings: ControllerSettings, slider: Slider, speed: float) -> None:
        self._settings, self._slider = settings, slider
        self._speed = speed
        weights = _weights(settings, speed)
        self.solvers = (TrackingQP(settings.horizon_steps, SPACE, weights),)
        self._iteration = RealTimeIteration(
            settings.horizon_steps, SPACE.size, relinearise=settings.relinearise
        )

    def staged(
        self, model: TabulatedModel, plan: Plan, stride: int, _slider: Slider
    ) -> StagedPlan:
        """See `Steering.staged`."""
        target = steady_shift(TravelMotion(model, self._slider.tip_x), plan)
        motion = TravelMotion(
            model.lookup(self._settings.horizon_steps),
            self._slider.tip_x,
            self._settings.sideways_response,
        )
        contact, mean = contact_after(plan, stride), mean_over_steps(plan.input, stride)
        stages = Stages.of(SPACE, target, self._limits(contact, mean))
        excess = np.zeros_like(plan.state)
        return StagedPlan(plan, motion, stride, contact, mean, excess, (stages,))

    def take(self, _slider: Slider) -> None:
        """See `Steering.take`; only the model knows friction and support radius."""

    def change(self, settings: ControllerSettings) -> None:
        """See `Steering.change`."""
        self._settings = settings
        self.solvers[0].weigh(_weights(settings, self._speed))

    def bounded(self, staged: StagedPlan) -> StagedPlan:
        """See `Steering.bounded`."""
        limits = self._limits(staged.contact, staged.mean_input)
        return replace(staged, stages=(staged.stages[0].within(limits),))

    def prepare(self, staged: StagedPlan, samples: Array) -> None:
        """See `Steering.prepare`."""
        dynamics = self._iteration.prepare(staged, samples)
        (stages,) = staged.stages
        self.solvers[0].prepare(stages, samples[:-1], stages, dynamics)

    def forget(self) -> None:
        """See `Steering.forget`."""
        self._iteration.forget()
        self.solvers[0].forget()

    def solve(
        self,
        staged: StagedPlan,
        _state: Array,
        deviation: Array,
        time: float,
        widening: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """See `Steering.solve`."""
        nominal = staged.plan.at(time)[1]
        (solver,) = self.solvers
        solution = solver.solve(deviation, widening, disturbance, sent - nominal)
        self._iteration.keep(solution)
        return Move(
            nominal + solution.inputs[0],
            solution.status,
            solution.iterations,
            '' if solution.usable else solver.largest_violation(),
            solution.states,
        )

    def _limits(self, contact: Array, inputs: Array) -> tuple[Array, Array]:
        """Lowest and highest deviations (n, 3) of [p_y, v_n, v_t] from the nominal."""
        nominal = np.column_stack([contact, inputs])
        half, tangential = 0.5 * self._slider.side, self._settings.tangential_speed_limit
        low = np.array([-half, 0.0, -tangential])
        high = np.array([half, self._settings.normal_speed_limit, tangential])
        return low - nominal, high - nominal


def _weights(settings: ControllerSettings, speed: float) -> QPWeights:
    weights = settings.weights
    share = change_share(speed) if settings.relinearise else 1.0
    return QPWeights(
        np.array([weights.position_x, weights.position_y, weights.heading, weights.contact]),
        np.array([weights.normal, weights.tangential]),
        np.full(2, share * weights.change),
        np.full(2, share * weights.smoothness),
    )
