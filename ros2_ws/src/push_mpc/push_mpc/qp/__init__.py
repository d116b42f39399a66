"""The QP of one tick: linearised stages, cost, constraints, solver."""

from push_mpc.qp.force_steering import ForceSteering
from push_mpc.qp.problem import Problem
from push_mpc.qp.solution import PlannedStates
from push_mpc.qp.solver import OSQP_SETTINGS
from push_mpc.qp.stages import NX
from push_mpc.qp.steering import Move, StagedPlan, Steering
from push_mpc.qp.velocity_steering import VelocitySteering

__all__ = [
    'NX',
    'OSQP_SETTINGS',
    'ForceSteering',
    'Move',
    'PlannedStates',
    'Problem',
    'StagedPlan',
    'Steering',
    'VelocitySteering',
]
