"""Learning while pushing: the pushes of a lap, and the motion cone that they tell of."""

from push_gp.learn.cone_learner import ConeLearner
from push_gp.learn.identification import Identified, identified
from push_gp.learn.lap_learner import LapLearner, Learned
from push_gp.learn.laps import LapCollector, Measured, MeasuredLap
from push_gp.learn.lesson_file import read_lesson, write_lesson
from push_gp.learn.reference_shift import ReferenceShift
from push_gp.learn.segments import interrupted, segments
from push_gp.learn.timed_reference import TimedReference

__all__ = [
    'ConeLearner',
    'Identified',
    'LapCollector',
    'LapLearner',
    'Learned',
    'Measured',
    'MeasuredLap',
    'ReferenceShift',
    'TimedReference',
    'identified',
    'interrupted',
    'read_lesson',
    'segments',
    'write_lesson',
]
