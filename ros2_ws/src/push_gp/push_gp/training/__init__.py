"""Fitting a model to pushes: cone, hyperparameters, prior."""
