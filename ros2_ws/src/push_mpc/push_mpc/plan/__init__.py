"""The nominal: state and input along a track."""

from push_mpc.plan.consistent_plan import consistent_plan
from push_mpc.plan.nominal import Plan
from push_mpc.plan.planning import planned

__all__ = ['Plan', 'consistent_plan', 'planned']
