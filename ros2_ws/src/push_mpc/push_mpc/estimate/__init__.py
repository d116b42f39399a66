"""Where the object is, and where it will be when a command acts: filter and delay predictor."""

from push_mpc.estimate.face import FaceEstimator
from push_mpc.estimate.link_estimate import LinkEstimate
from push_mpc.estimate.object_filter import ObjectFilter
from push_mpc.estimate.pose_gate import PoseGate
from push_mpc.estimate.predictor import Predictor
from push_mpc.estimate.tip_history import TipHistory

__all__ = [
    'FaceEstimator',
    'LinkEstimate',
    'ObjectFilter',
    'PoseGate',
    'Predictor',
    'TipHistory',
]
