"""Serves one page to browsers, and sends it the state of the cell as it changes.

Server-sent events: the page holds one request open, on which each state is a line of JSON. A page
that is slower than the cell gets the newest state, not all of them.
"""

import contextlib
import threading
from collections.abc import Callable, Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from push_core.common import RunError

HEADER = 'X-Push-Control'
"""A page of another origin cannot send it, so no other page can move the tip."""
_ALIVE = 5.0  # [s] between two signs of life, on which a browser that left is noticed


class PageServer:
    """An HTTP server in threads of its own.

    Attributes:
        texts: type and maker of the text at each path.
        act: does what a button asks for; None without buttons.
    """

    def __init__(
        self,
        host: str,
        port: int,
        texts: Mapping[str, tuple[str, Callable[[], str]]],
        act: Callable[[str], str] | None,
    ) -> None:
        """Starts the server.

        Args:
            host: address to listen on.
            port: TCP port; 0 for any free one.
            texts: type and maker of the text at each path.
            act: does what a button of the page asks for and returns the answer; None without
                buttons.

        Raises:
            RunError: the address or port is not available.
        """
        self.texts, self.act = texts, act
        self._news = threading.Condition()
        self._state, self._number = '', 0
        self._pages, self._closed = 0, False
        try:
            self._server = _Server((host, port), _Handler)
        except OSError as error:
            raise RunError(f'cannot serve a page at {host}:{port}: {error.strerror}') from error
        self._server.owner = self
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    @property
    def port(self) -> int:
        """TCP port of the server."""
        return int(self._server.server_address[1])

    @property
    def watched(self) -> bool:
        """Whether a page is open."""
        return self._pages > 0

    def show(self, state: str) -> None:
        """Sends a state to all pages."""
        with self._news:
            self._state, self._number = state, self._number + 1
            self._news.notify_all()

    def close(self) -> None:
        """Stops the server."""
        with self._news:
            self._closed = True
            self._news.notify_all()
        self._server.shutdown()
        self._server.server_close()

    def send_to(self, write: Callable[[str], None]) -> None:
        """Writes each new state as an event, until the page leaves or the server stops."""
        with self._news:
            self._pages += 1
        try:
            seen = 0
            while not self._closed:
                with self._news:
                    if self._number == seen and not self._closed:
                        self._news.wait(_ALIVE)
                    fresh, state = self._number != seen, self._state
                    seen = self._number
                write(f'data: {state}\n\n' if fresh else ': still here\n\n')
        finally:
            with self._news:
                self._pages -= 1


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    owner: PageServer


class _Handler(BaseHTTPRequestHandler):
    server: _Server

    def do_GET(self) -> None:
        """Sends a text, or states as they come."""
        owner = self.server.owner
        if self.path == '/events':
            self._send_events()
        elif self.path in owner.texts:
            kind, make = owner.texts[self.path]
            self._answer(HTTPStatus.OK, kind, make())
        else:
            self._answer(HTTPStatus.NOT_FOUND, 'text/plain', 'nothing here')

    def do_POST(self) -> None:
        """Does what a button asks for."""
        act = self.server.owner.act
        if act is None or self.headers.get(HEADER) is None:
            self._answer(HTTPStatus.FORBIDDEN, 'text/plain', 'start live with --control')
        else:
            self._answer(HTTPStatus.OK, 'text/plain', act(self.path.strip('/')))

    def log_message(self, *_arguments: object) -> None:
        """Writes nothing: the terminal is the node's."""

    def _send_events(self) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header('Content-Type', 'text/event-stream')
        self.send_header('Cache-Control', 'no-store')
        self.end_headers()
        # raised when the page was closed
        with contextlib.suppress(OSError):
            self.server.owner.send_to(self._write)

    def _answer(self, status: HTTPStatus, kind: str, text: str) -> None:
        body = text.encode()
        self.send_response(status)
        self.send_header('Content-Type', f'{kind}; charset=utf-8')
        self.send_header('Content-Length', str(len(body)))
        self.send_header('Cache-Control', 'no-store')
        self.end_headers()
        self.wfile.write(body)

    def _write(self, text: str) -> None:
        self.wfile.write(text.encode())
        self.wfile.flush()
