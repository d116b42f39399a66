"""The live view: shows every topic of a running or replayed cell in the browser.

ros2 run push_bag live          then open https://app.foxglove.dev, "Open connection",
ws://127.0.0.1:8765, and import the layout
"""

import sys
from collections.abc import Sequence
from dataclasses import dataclass

from push_core.common import setting, validate
from push_node.graph import full_name
from push_node.interface import TOPICS
from push_node.parameters import declared
from push_node.spin import run_node
from rclpy.clock import Clock, ClockType
from rclpy.node import Node

from push_bag.file import qos_text
from push_bag.live.live_server import LiveServer
from push_bag.record import split_list
from push_bag.record.recording import Recording

DRAIN_PERIOD = 0.02  # [s]; a browser draws no faster
DISCOVERY_PERIOD = 0.2  # [s]


@dataclass(frozen=True)
class LiveSettings:
    """Parameters of the live view."""

    host: str = setting('127.0.0.1', 'address to listen on; 0.0.0.0 for every network')
    port: int = setting(8765, 'TCP port; 0 for any free one', low=0, high=65535)
    topics: str = setting(
        '', 'more topics to show: names or patterns (/arm/*), separated by commas'
    )

    def __post_init__(self) -> None:
        validate(self)


class Live(Node):  # type: ignore[misc]
    """Shows a running or replayed cell in the browser, over the Foxglove WebSocket protocol.

      ros2 run push_bag live
      ros2 run push_bag live --ros-args -p port:=9000 -p topics:="/arm/*"

    Then open https://app.foxglove.dev, choose "Open connection" and ws://127.0.0.1:8765, and
    import the layout foxglove_layout.json of push_bringup's config folder.

    host     address to listen on: 127.0.0.1 (default), or 0.0.0.0 for every network
    port     TCP port; 8765
    topics   more topics to show: names or patterns, separated by commas
    """

    def __init__(self) -> None:
        super().__init__('live', automatically_declare_parameters_from_overrides=True)
        settings = declared(self, LiveSettings())
        own = {self.resolve_topic_name(topic.name): topic for topic in TOPICS}
        offers = {name: topic.qos for name, topic in own.items()}
        others = {full_name(self, name) for name in split_list(settings.topics)}
        known = [(name, topic.type_name, qos_text(topic.qos)) for name, topic in own.items()]
        server = LiveServer(settings.host, settings.port, known)
        self._recording = Recording(self, server, {*offers, *others}, offers)
        # steady, because simulated time may stand still
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(DRAIN_PERIOD, self._recording.drain, clock=steady)
        self.create_timer(DISCOVERY_PERIOD, self._recording.discover, clock=steady)
        address = f'ws://{settings.host}:{server.port}'
        self.get_logger().info(f'open {address} in Foxglove (https://app.foxglove.dev)')

    def destroy_node(self) -> None:
        """Also stops the server."""
        self._recording.close()
        super().destroy_node()


def main(argv: Sequence[str] | None = None) -> int:
    """Serves until SIGINT or SIGTERM."""
    return run_node(Live, argv)


if __name__ == '__main__':
    sys.exit(main())
