"""Nodes that fail on request, and how they are asked."""

from push_bringup.faults.sick.ailment import FAULT_FILE

__all__ = ['FAULT_FILE']
