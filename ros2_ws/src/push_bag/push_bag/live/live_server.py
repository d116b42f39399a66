"""Serves the cell's messages to a browser over the Foxglove WebSocket protocol.

Takes the place of a bag: a `Recording` writes into it what would go into a file. Messages of
latched topics are kept and shown again to whoever subscribes later, as DDS does. The planned
horizon is shown a second time, as a marker on `horizon_line`.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import foxglove
from foxglove.websocket import ServerListener
from push_core.common import RunError

from push_bag.file import schema_text
from push_bag.live.horizon_marker import HORIZON_TYPE, MARKER_TYPE, horizon_marker


class LiveServer(ServerListener):
    """A `RawSink` that browsers watch; nothing is kept but what latched topics said last."""

    def __init__(self, host: str, port: int, topics: Iterable[tuple[str, str, str]]) -> None:
        """Starts to listen.

        Args:
            host: address to listen at.
            port: of TCP; 0 takes any that is free.
            topics: that are announced before anybody watches, as `add_topic` takes them. A
                browser that is there when a topic is announced may ask for it too early.

        Raises:
            RunError: it cannot listen there.
        """
        self._context = foxglove.Context()
        self._channels: dict[str, Any] = {}
        self._latched: dict[str, bytes] = {}
        self._lines: dict[str, Any] = {}
        for topic in topics:
            self.add_topic(*topic)
        try:
            self._server = foxglove.start_server(
                name='pushing cell',
                host=host,
                port=port,
                server_listener=self,
                context=self._context,
            )
        except (RuntimeError, OSError, ValueError) as error:
            raise RunError(f'cannot serve at {host}:{port}: {error}') from error

    @property
    def port(self) -> int:
        """Where it listens."""
        return int(self._server.port)

    @property
    def is_open(self) -> bool:
        """Whether it takes messages."""
        return True

    def add_topic(self, name: str, type_name: str, qos_yaml: str) -> None:
        """Announces a topic that is not announced yet; see `BagWriter.add_topic`.

        Raises:
            InputError: the type is not installed.
        """
        if name in self._channels:
            return
        self._channels[name] = self._channel(name, type_name)
        if type_name == HORIZON_TYPE:
            self._lines[name] = self._channel(f'{name}_line', MARKER_TYPE)
        if 'durability: transient_local' in qos_yaml:
            self._latched[name] = b''

    def write(
        self, name: str, data: bytes, log_ns: int, _publish_ns: int, _sequence: int = 0
    ) -> None:
        """Sends one serialized message to everyone who watches its topic."""
        if name in self._latched:
            self._latched[name] = data
        self._channels[name].log(data, log_time=log_ns)
        if name in self._lines:
            self._lines[name].log(horizon_marker(data), log_time=log_ns)

    def flush(self) -> None:
        """Nothing waits."""

    def note(self, _name: str, _values: Mapping[str, str]) -> None:
        """Nobody asks how the recording went."""

    def close(self) -> None:
        """Stops to listen."""
        self._server.stop()

    def on_subscribe(self, _client: Any, channel: Any) -> None:
        """Shows what a latched topic said last."""
        if self._latched.get(channel.topic):
            self._channels[channel.topic].log(self._latched[channel.topic])

    def _channel(self, name: str, type_name: str) -> Any:
        text = schema_text(type_name).encode()
        schema = foxglove.Schema(name=type_name, encoding='ros2msg', data=text)
        return foxglove.Channel(name, schema=schema, message_encoding='cdr', context=self._context)
