"""Serves a running cell to viewers in a browser."""
