"""The data-driven controller: one program over the tip's velocity [v_n, v_t].

Bauza, Hogan and Rodriguez 2018, section 4, for any model of the object's displacement.
"""

import numpy as np
from push_core.geometry import Array
from push_core.physics import Slider

from push_mpc.motion import TravelModel, TravelMotion
from push_mpc.plan import Plan
from push_mpc.qp.preview import Preview
from push_mpc.qp.stages import InputSpace, Stages
from push_mpc.qp.steering import Move, Programs
from push_mpc.qp.tracking_qp import TrackingQP
from push_mpc.settings import ControllerSettings

SPACE = InputSpace(np.full(2, 1e-2), np.eye(2), np.full(2, 1e-2))


class VelocitySteering:
    """See `Steering`."""

    solvers: tuple[TrackingQP, ...]

    def __init__(self, settings: ControllerSettings, slider: Slider) -> None:
        self._settings, self._slider = settings, slider
        weights = settings.weights
        solver = TrackingQP(
            settings.horizon_steps,
            SPACE,
            np.array([weights.position_x, weights.position_y, weights.heading, weights.contact]),
            np.array([weights.normal, weights.tangential]),
            np.full(2, weights.change),
        )
        self.solvers = (solver,)

    def programs(self, model: TravelModel, plan: Plan, stride: int) -> Programs:
        """See `Steering.programs`."""
        motion = TravelMotion(model, self._slider.tip_x)
        preview = Preview.of(plan, motion, stride)
        return Programs(plan, (Stages.of(SPACE, preview, self._limits(preview)),))

    def prepare(self, programs: Programs, window: Array) -> None:
        """See `Steering.prepare`."""
        (stages,) = programs.stages
        self.solvers[0].prepare(stages, window, stages)

    def solve(
        self,
        programs: Programs,
        _state: Array,
        deviation: Array,
        time: float,
        opening: float,
        disturbance: Array,
        sent: Array,
    ) -> Move:
        """See `Steering.solve`."""
        nominal = programs.plan.at(time)[1]
        solution = self.solvers[0].solve(deviation, opening, disturbance, sent - nominal)
        velocity = nominal + solution.inputs[0]
        return Move(
            velocity, solution.status, solution.iterations, solution.usable, solution.states
        )

    def _limits(self, preview: Preview) -> tuple[Array, Array]:
        """Lowest and highest deviations (n, 3) of [p_y, v_n, v_t] from the nominal."""
        nominal = np.column_stack([preview.contact, preview.input])
        half, tangential = 0.5 * self._slider.side, self._settings.tangential_speed_limit
        low = np.array([-half, 0.0, -tangential])
        high = np.array([half, self._settings.normal_speed_limit, tangential])
        return low - nominal, high - nominal
