"""Measured pushes and robot runs, and their repetition in a world."""
