"""Shows a running cell to viewers: lines of the plan as markers, and a server for browsers."""

from push_bag.live.plan_markers import horizon_marker, plan_markers, reference_marker

__all__ = ['horizon_marker', 'plan_markers', 'reference_marker']
