"""Errors of a model on held-out pushes: figures and pages."""

from push_gp.evaluation.evaluation import (
    Evaluation,
    RolloutEvaluation,
    evaluate,
    rollout_evaluation,
)
from push_gp.evaluation.learning_curve import METHODS, Place, learning_curve, sizes_within
from push_gp.evaluation.summary import training_summary

__all__ = [
    'METHODS',
    'Evaluation',
    'Place',
    'RolloutEvaluation',
    'evaluate',
    'learning_curve',
    'rollout_evaluation',
    'sizes_within',
    'training_summary',
]
