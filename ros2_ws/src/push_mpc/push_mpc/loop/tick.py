"""The record of one tick."""

import math
from dataclasses import dataclass

from push_core.geometry import Array

from push_mpc.loop.modes import Mode
from push_mpc.qp import PlannedStates


@dataclass
class Tick:
    """Inputs, intermediate results and output of one tick; times count from the first pose.

    Attributes:
        mode: of the controller after the tick.
        velocity: command (2,) [m/s], world frame.
        reference_time: time of the reference at the exposure [s]; -inf without new poses.
        exposure: time of the measurement [s]; NaN without new poses.
        now: time at which the command is sent [s].
        state: measured [x, y, theta, p_y] (4,) [m, m, rad, m]; None without new poses.
        predicted: the same at the time at which the command takes effect.
        reference: planned state (4,) at that time.
        gap: measured distance between tip and face [m], negative in contact by overlap.
        input: commanded [v_n, v_t] (2,) [m/s], body frame.
        nominal_input: planned [v_n, v_t] (2,) [m/s].
        estimate: filtered pose (3,) [m, m, rad] at the newest exposure.
        innovation: measured pose minus its prediction (3,); None without new poses.
        innovation_deviation: its standard deviation that the filter expected.
        disturbance: estimated error of the model (3,) [1, 1, rad/m], see `ObjectFilter`.
        solve_ms: duration of the QP [ms].
        iterations: of the solver, summed over the QPs of the tick.
        solver_status: of OSQP, 1 = solved.
        limited: bits of `push_core.physics.limit`: which limits changed the command.
        planned: the predicted horizon, None if no QP was solved.
    """

    mode: Mode
    velocity: Array
    reference_time: float = -math.inf
    exposure: float = math.nan
    now: float = math.nan
    state: Array | None = None
    predicted: Array | None = None
    reference: Array | None = None
    gap: float = 0.0
    input: Array | None = None
    nominal_input: Array | None = None
    estimate: Array | None = None
    innovation: Array | None = None
    innovation_deviation: Array | None = None
    disturbance: Array | None = None
    solve_ms: float = 0.0
    iterations: int = 0
    solver_status: int = 0
    limited: int = 0
    planned: PlannedStates | None = None
