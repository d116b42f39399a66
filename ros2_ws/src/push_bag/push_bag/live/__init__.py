"""Shows a running cell to viewers: lines of the plan as markers, and a server for browsers."""

from push_bag.live.plan_markers import horizon_marker, marker_array, reference_marker

__all__ = ['horizon_marker', 'marker_array', 'reference_marker']
