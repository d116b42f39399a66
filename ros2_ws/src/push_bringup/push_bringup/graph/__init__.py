"""The nodes of a cell as processes, from start to stop."""

from push_bringup.graph.processes import MODULES, Processes

__all__ = ['MODULES', 'Processes']
