"""Measured runs of the real cell as bags."""
