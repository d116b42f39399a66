"""Laps of an experiment, computed in several processes and kept."""

from push_bringup.experiment.experiment import PAPER_MM, Experiment, LapJob
from push_bringup.experiment.lap import Lap, pushed
from push_bringup.experiment.lap_pool import LapStore, push_all

__all__ = [
    'PAPER_MM',
    'Experiment',
    'Lap',
    'LapJob',
    'LapStore',
    'push_all',
    'pushed',
]
