"""Laps of an experiment, computed in several processes and kept."""

from push_bringup.experiment.experiment import PAPER_MM, Experiment, Lap, LapJob, pushed
from push_bringup.experiment.lap_pool import LapStore, cores, push_all, worker_pool

__all__ = [
    'PAPER_MM',
    'Experiment',
    'Lap',
    'LapJob',
    'LapStore',
    'cores',
    'push_all',
    'pushed',
    'worker_pool',
]
