"""Measurements of the recorder."""
