"""The data-driven controller: one QP over the tip's velocity [v_n, v_t].

Works with any model of the object's displacement. Source: Bauza, Hogan and Rodriguez 2018,
section 4.
"""

from dataclasses import replace

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

from push_mpc.motion import TravelModel, TravelMotion
from push_mpc.plan import Plan
from push_mpc.qp.preview import Preview
from push_mpc.qp.stages import InputSpace, Stages
from push_mpc.qp.steering import LinearisedPlan, Move
from push_mpc.qp.tracking_qp import QPWeights, TrackingQP
from push_mpc.settings import ControllerSettings

SPACE = InputSpace(np.full(2, 1e-2), np.eye(2), np.full(2, 1e-2), ('v_n [m/s]', 'v_t [m/s]'))


class VelocitySteering:
    """See `Steering`."""

    solvers: tuple[TrackingQP, ...]

    def __init__(self, settings: ControllerSettings, slider: Slider) -> None:
        self._settings, self._slider = settings, slider
        self.solvers = (TrackingQP(settings.horizon_steps, SPACE, _weights(settings)),)

    def linearised(self, model: TravelModel, plan: Plan, stride: int) -> LinearisedPlan:
        """See `Steering.linearised`."""
        motion = TravelMotion(model, self._slider.tip_x)
        preview = Preview.of(plan, motion, stride)
        stages = Stages.of(SPACE, preview, self._limits(preview.contact, plan.input))
        return LinearisedPlan(plan, preview.contact, (stages,))

    def of_slider(self, _slider: Slider) -> 'VelocitySteering':
        """See `Steering.of_slider`; only its model knows friction and support radius."""
        return self

    def change(self, settings: ControllerSettings) -> None:
        """See `Steering.change`."""
        self._settings = settings
        self.solvers[0].weigh(_weights(settings))

    def bounded(self, linearised: LinearisedPlan) -> LinearisedPlan:
        """See `Steering.bounded`."""
        limits = self._limits(linearised.contact, linearised.plan.input)
        return replace(linearised, stages=(linearised.stages[0].within(limits),))

    def prepare(self, linearised: LinearisedPlan, window: Array) -> None:
        """See `Steering.prepare`."""
        (stages,) = linearised.stages
        self.solvers[0].prepare(stages, window, stages)

    def solve(
        self,
        linearised: LinearisedPlan,
        _state: Array,
        deviation: Array,
        time: float,
        widening: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """See `Steering.solve`."""
        nominal = linearised.plan.at(time)[1]
        (solver,) = self.solvers
        solution = solver.solve(deviation, widening, disturbance, sent - nominal)
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


def _weights(settings: ControllerSettings) -> QPWeights:
    weights = settings.weights
    return QPWeights(
        np.array([weights.position_x, weights.position_y, weights.heading, weights.contact]),
        np.array([weights.normal, weights.tangential]),
        np.full(2, weights.change),
    )
