"""Laps on plants that differ from what the controller assumes."""

from push_bringup.mismatch.plants import PLANTS, Plant

__all__ = ['PLANTS', 'Plant']
