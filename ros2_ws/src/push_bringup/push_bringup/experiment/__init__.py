"""Laps of an experiment, computed in several processes and kept."""
