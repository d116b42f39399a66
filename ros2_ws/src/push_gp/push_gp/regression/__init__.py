"""Gaussian process regression: kernel, likelihood, posterior."""

from push_gp.regression.gp import GaussianProcess, factor
from push_gp.regression.kernel import Hyperparameters, input_features, query_features
from push_gp.regression.likelihood import MarginalLikelihood

__all__ = [
    'GaussianProcess',
    'Hyperparameters',
    'MarginalLikelihood',
    'factor',
    'input_features',
    'query_features',
]
