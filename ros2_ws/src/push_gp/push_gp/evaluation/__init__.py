"""Evaluation of a model on measured pushes: errors, learning curve, pages."""

from push_gp.evaluation.curve import METHODS, CurvePoint, curve_sizes, learning_curve
from push_gp.evaluation.evaluation import (
    Evaluation,
    RolloutEvaluation,
    evaluate,
    rollout_evaluation,
)
from push_gp.evaluation.summary import training_summary

__all__ = [
    'METHODS',
    'CurvePoint',
    'Evaluation',
    'RolloutEvaluation',
    'curve_sizes',
    'evaluate',
    'learning_curve',
    'rollout_evaluation',
    'training_summary',
]
