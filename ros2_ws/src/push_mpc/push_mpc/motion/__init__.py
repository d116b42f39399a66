"""Equations of motion of the pushed object, and their Jacobians."""
