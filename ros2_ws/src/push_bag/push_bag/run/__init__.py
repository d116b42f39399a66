"""A recorded run as arrays."""

from push_bag.run.conversions import nanoseconds
from push_bag.run.horizons import Horizons
from push_bag.run.recorded_ticks import ByStamp, RecordedRun, RecordedTick
from push_bag.run.run_reader import read_run
from push_bag.run.series import Disturbance, Floats, Nanoseconds, Reference, RunSeries, Stamped

__all__ = [
    'ByStamp',
    'Disturbance',
    'Floats',
    'Horizons',
    'Nanoseconds',
    'RecordedRun',
    'RecordedTick',
    'Reference',
    'RunSeries',
    'Stamped',
    'nanoseconds',
    'read_run',
]
