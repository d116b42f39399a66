"""The nominal: state and input along a track."""

from push_mpc.plan.leaning import agreeing_plan
from push_mpc.plan.lesson import Lesson
from push_mpc.plan.nominal import Plan
from push_mpc.plan.placement import Placement
from push_mpc.plan.planning import check_pushes, planned

__all__ = [
    'Lesson',
    'Placement',
    'Plan',
    'agreeing_plan',
    'check_pushes',
    'planned',
]
