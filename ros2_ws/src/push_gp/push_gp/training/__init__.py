"""Fitting a model to pushes: cone, hyperparameters, prior."""

from push_gp.training.prior import OVER_ZERO, priors

__all__ = ['OVER_ZERO', 'priors']
