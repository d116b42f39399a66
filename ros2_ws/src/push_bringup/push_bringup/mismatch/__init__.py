"""Laps on plants that differ from what the controller assumes."""

from push_bringup.mismatch.plants import PLANTS, PlantVariant

__all__ = ['PLANTS', 'PlantVariant']
