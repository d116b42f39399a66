"""Simulated short pushes as training data."""

from push_sim.collect.collection import collect_pushes
from push_sim.collect.collector import Collector
from push_sim.collect.push_design import PushDesign
from push_sim.collect.push_sampling import SAMPLINGS, Sampler, uniform
from push_sim.collect.short_push import PushTiming, execute_push, push_row

__all__ = [
    'SAMPLINGS',
    'Collector',
    'PushDesign',
    'PushTiming',
    'Sampler',
    'collect_pushes',
    'execute_push',
    'push_row',
    'uniform',
]
