"""The live view: shows a running or replayed cell in the browser, on a page of its own.

ros2 run push_bag live          then open http://127.0.0.1:8766; for Foxglove or Lichtblick the
server ws://127.0.0.1:8765 offers every topic
"""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from queue import Empty, SimpleQueue
from typing import Any

from push_core.common import setting, validate
from push_node.graph import full_name
from push_node.interface import TOPICS
from push_node.parameters import declared
from push_node.spin import run_node
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from std_srvs.srv import Trigger

from push_bag.file import qos_text
from push_bag.live import CellView, PageServer
from push_bag.live.live_server import LiveServer
from push_bag.record import split_list
from push_bag.record.recording import Recording
from push_bag.report.live_page import ACTIONS, live_page

CONTROL = '--control'
PAGE_PERIOD = 0.05  # [s]
PATIENCE = 5.0  # [s] with a service
DRAIN_PERIOD = 0.02  # [s]; a browser draws no faster
DISCOVERY_PERIOD = 0.2  # [s]


@dataclass(frozen=True)
class LiveSettings:
    """Parameters of the live view."""

    host: str = setting('127.0.0.1', 'address to listen on; 0.0.0.0 for every network')
    port: int = setting(
        8765, 'TCP port for Foxglove and Lichtblick; 0 for any free one', low=0, high=65535
    )
    page_port: int = setting(8766, 'TCP port of the page; 0 for any free one', low=0, high=65535)
    control: bool = setting(False, 'buttons on the page that reset, start, stop and resume')
    topics: str = setting(
        '', 'more topics to show: names or patterns (/arm/*), separated by commas'
    )

    def __post_init__(self) -> None:
        validate(self)


class Live(Node):  # type: ignore[misc]
    """Shows a running or replayed cell in the browser: a page, and a server for Foxglove.

      ros2 run push_bag live              then open http://127.0.0.1:8766
      ros2 run push_bag live --control    with buttons that reset, start, stop and resume
      ros2 run push_bag live --ros-args -p port:=9000 -p topics:="/arm/*"

    The page needs no network. Foxglove (https://app.foxglove.dev) and Lichtblick show every topic
    at ws://127.0.0.1:8765; foxglove_layout.json of push_bringup's config folder is a layout.

    host       address to listen on: 127.0.0.1 (default), or 0.0.0.0 for every network
    port       TCP port for Foxglove; 8765
    page_port  TCP port of the page; 8766
    control    the same as --control
    topics     more topics to show: names or patterns, separated by commas
    """

    def __init__(self) -> None:
        super().__init__('live', automatically_declare_parameters_from_overrides=True)
        settings = declared(self, LiveSettings())
        self._view = CellView()
        server = self._foxglove(settings)
        self._asked: SimpleQueue[tuple[str, SimpleQueue[str]]] = SimpleQueue()
        self._buttons = {
            name: service.client(self)
            for name, (_, service) in ACTIONS.items()
            if settings.control
        }
        html = live_page(settings.control)
        texts = {'/': ('text/html', lambda: html), '/plan.json': ('application/json', self._plan)}
        act = self._act if settings.control else None
        self._page = PageServer(settings.host, settings.page_port, texts, act)
        # steady, because simulated time may stand still
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(DRAIN_PERIOD, self._recording.drain, clock=steady)
        self.create_timer(PAGE_PERIOD, self._show, clock=steady)
        self.create_timer(DISCOVERY_PERIOD, self._recording.discover, clock=steady)
        self.get_logger().info(
            f'open http://{settings.host}:{self._page.port} in a browser, '
            f'or ws://{settings.host}:{server.port} in Foxglove or Lichtblick'
        )

    def destroy_node(self) -> None:
        """Also stops the servers."""
        self._page.close()
        self._recording.close()
        super().destroy_node()

    def _foxglove(self, settings: LiveSettings) -> LiveServer:
        own = {self.resolve_topic_name(topic.name): topic for topic in TOPICS}
        offers = {name: topic.qos for name, topic in own.items()}
        others = {full_name(self, name) for name in split_list(settings.topics)}
        known = [(name, topic.type_name, qos_text(topic.qos)) for name, topic in own.items()]
        server = LiveServer(settings.host, settings.port, known, self._view.take)
        self._recording = Recording(self, server, {*offers, *others}, offers)
        return server

    def _show(self) -> None:
        """Sends the state to open pages, and passes on what their buttons asked for."""
        while not self._asked.empty():
            name, answers = self._asked.get()
            client = self._buttons.get(name)
            if client is None or not client.service_is_ready():
                answers.put('the cell offers no such service')
                continue
            future = client.call_async(Trigger.Request())
            future.add_done_callback(partial(_answer, answers))
        if self._page.watched:
            self._page.show(self._view.snapshot())

    def _plan(self) -> str:
        return self._view.plan()

    def _act(self, name: str) -> str:
        """The answer to a button; called in a thread of the page's server."""
        answers: SimpleQueue[str] = SimpleQueue()
        self._asked.put((name, answers))
        try:
            return answers.get(timeout=PATIENCE)
        except Empty:
            return f'no answer within {PATIENCE:g} s'


def _answer(answers: 'SimpleQueue[str]', future: Any) -> None:
    answers.put(str(future.result().message))


def main(argv: Sequence[str] | None = None) -> int:
    """Serves until SIGINT or SIGTERM."""
    given = [*(sys.argv[1:] if argv is None else argv)]
    if CONTROL in given:
        given.remove(CONTROL)
        given += ['--ros-args', '-p', 'control:=true']
    return run_node(Live, given)


if __name__ == '__main__':
    sys.exit(main())
