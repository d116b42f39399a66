"""Short pushes made in a world, as training data."""

from push_sim.collect.collection import collect_pushes
from push_sim.collect.collector import Collector
from push_sim.collect.push_design import PushDesign
from push_sim.collect.push_sampling import SAMPLINGS, Aim, uniform
from push_sim.collect.short_push import PushTiming, push_row, short_push

__all__ = [
    'SAMPLINGS',
    'Aim',
    'Collector',
    'PushDesign',
    'PushTiming',
    'collect_pushes',
    'push_row',
    'short_push',
    'uniform',
]
