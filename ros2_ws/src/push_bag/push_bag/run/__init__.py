"""A recorded run as arrays."""

from push_bag.run.conversions import nanoseconds
from push_bag.run.horizons import Horizons
from push_bag.run.recorded_ticks import ByStamp, RecordedRun, RecordedTick
from push_bag.run.run_reader import read_run, read_starts
from push_bag.run.series import (
    PAIRED,
    DrivenLesson,
    Floats,
    Nanoseconds,
    PerturbationEvent,
    Reference,
    RunSeries,
    Stamped,
)

__all__ = [
    'PAIRED',
    'ByStamp',
    'DrivenLesson',
    'Floats',
    'Horizons',
    'Nanoseconds',
    'PerturbationEvent',
    'RecordedRun',
    'RecordedTick',
    'Reference',
    'RunSeries',
    'Stamped',
    'nanoseconds',
    'read_run',
    'read_starts',
]
