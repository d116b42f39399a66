"""Shows a running cell: a page and a server for browsers, lines of the plan as markers."""

from push_bag.live.cell_view import CellView
from push_bag.live.page_server import PageServer
from push_bag.live.plan_markers import horizon_marker, marker_array, reference_marker

__all__ = ['CellView', 'PageServer', 'horizon_marker', 'marker_array', 'reference_marker']
