"""Serves the cell's messages to browsers over the Foxglove WebSocket protocol.

A `Recording` writes to it as to a bag. The last message of a latched topic is sent to later
subscribers, as DDS does. The planned horizon is also sent as a marker, on `horizon_line`.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import foxglove
from foxglove.websocket import ServerListener
from push_core.common import RunError

from push_bag.file import schema_text
from push_bag.live.horizon_marker import HORIZON_TYPE, MARKER_TYPE, serialized_marker


class LiveServer(ServerListener):
    """A `RawSink` that sends messages to browsers; stores the last one of latched topics."""

    def __init__(
        self,
        host: str,
        port: int,
        topics: Iterable[tuple[str, str, str]],
        also: Callable[[str, bytes], None] = lambda *_: None,
    ) -> None:
        """Starts the server.

        Args:
            host: address to listen on.
            port: TCP port; 0 for any free one.
            topics: arguments of `add_topic` for topics to announce before the first client: a
                client that sees a topic being announced may subscribe too early.
            also: called with the topic and data of each message.

        Raises:
            RunError: the address or port is not available.
        """
        self._also = also
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
        """TCP port of the server."""
        return int(self._server.port)

    @property
    def is_open(self) -> bool:
        """Always True: only a bag can fail to be written."""
        return True

    def add_topic(self, name: str, type_name: str, qos_yaml: str) -> None:
        """Announces a topic, once; see `BagWriter.add_topic`.

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
        """Sends one serialized message to the subscribers of its topic."""
        if name in self._latched:
            self._latched[name] = data
        self._also(name, data)
        self._channels[name].log(data, log_time=log_ns)
        if name in self._lines:
            self._lines[name].log(serialized_marker(data), log_time=log_ns)

    def flush(self) -> None:
        """Does nothing: messages are sent at once."""

    def add_facts(self, _name: str, _facts: Mapping[str, str]) -> None:
        """Does nothing: clients are not interested in facts about the recording."""

    def close(self) -> None:
        """Stops the server."""
        self._server.stop()

    def on_subscribe(self, _client: Any, channel: Any) -> None:
        """Sends the last message of a latched topic to a new subscriber."""
        if self._latched.get(channel.topic):
            self._channels[channel.topic].log(self._latched[channel.topic])

    def _channel(self, name: str, type_name: str) -> Any:
        text = schema_text(type_name).encode()
        schema = foxglove.Schema(name=type_name, encoding='ros2msg', data=text)
        return foxglove.Channel(name, schema=schema, message_encoding='cdr', context=self._context)
