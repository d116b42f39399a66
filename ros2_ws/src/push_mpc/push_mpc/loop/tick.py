"""What the controller is doing, and what it tells of one tick."""

import math
from dataclasses import dataclass
from enum import IntEnum

from push_core.geometry import Array

from push_mpc.qp import PlannedStates


class Mode(IntEnum):
    """What the controller is doing; the numbers are those of push_msgs/ControllerState."""

    IDLE = 0
    ARMED = 1
    TRACKING = 2
    DONE = 3
    STOPPED = 4
    HOLDING = 5
    RECONTACT = 6


FOLLOWING = (Mode.TRACKING, Mode.RECONTACT)
"""Modes in which the reference runs."""


@dataclass
class Tick:
    """What one tick saw, planned and did; see push_msgs/ControllerState and Horizon."""

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
    solve_ms: float = 0.0
    iterations: int = 0
    solver_status: int = 0
    limited: int = 0
    planned: PlannedStates | None = None
