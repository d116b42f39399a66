"""`push_bag markers`: shows reference and horizon in RViz."""

import sys
from collections.abc import Sequence

from push_msgs.msg import Horizon, NominalTrajectory
from push_node import interface
from push_node.spin import run_node
from rclpy.node import Node
from visualization_msgs.msg import Marker

from push_bag.live import horizon_marker, marker_array, reference_marker


class Markers(Node):  # type: ignore[misc]
    """Publishes the reference and the planned horizon as markers, for RViz."""

    def __init__(self) -> None:
        super().__init__('markers')
        self._reference: Marker | None = None
        self._horizon: Marker | None = None
        self._publisher = interface.PLAN_MARKERS.publisher(self)
        interface.NOMINAL_TRAJECTORY.subscription(self, self._on_plan)
        interface.HORIZON.subscription(self, self._on_horizon)

    def _on_plan(self, message: NominalTrajectory) -> None:
        self._reference, self._horizon = reference_marker(message), None
        self._publish()

    def _on_horizon(self, message: Horizon) -> None:
        self._horizon = horizon_marker(message)
        self._publish()

    def _publish(self) -> None:
        self._publisher.publish(marker_array(self._reference, self._horizon))


def main(argv: Sequence[str] | None = None) -> int:
    """Publishes until SIGINT or SIGTERM."""
    return run_node(Markers, argv)


if __name__ == '__main__':
    sys.exit(main())
