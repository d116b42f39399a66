"""Learning while pushing: the pushes of a lap, and the motion cone that they tell of."""

from push_gp.learn.cone_learner import ConeLearner
from push_gp.learn.identification import Identified, identified
from push_gp.learn.segments import interrupted, segments

__all__ = ['ConeLearner', 'Identified', 'identified', 'interrupted', 'segments']
