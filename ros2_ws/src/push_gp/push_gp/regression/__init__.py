"""Gaussian process regression: kernel, likelihood, posterior."""
