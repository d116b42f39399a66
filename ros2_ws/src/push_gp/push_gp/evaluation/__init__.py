"""Errors of a model on held-out pushes: figures and pages."""
