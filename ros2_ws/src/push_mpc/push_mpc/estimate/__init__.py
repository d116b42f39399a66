"""Where the object will be when a command acts: delay predictor and disturbance estimate."""

from push_mpc.estimate.disturbance import DisturbanceEstimator
from push_mpc.estimate.pose_gate import PoseGate
from push_mpc.estimate.predictor import Predictor
from push_mpc.estimate.tip_history import TipHistory

__all__ = ['DisturbanceEstimator', 'PoseGate', 'Predictor', 'TipHistory']
