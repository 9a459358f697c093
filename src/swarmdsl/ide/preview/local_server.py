"""HTTP server on the loopback interface, for pages of this computer only."""

from __future__ import annotations

import json
import sys
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

HOST = "127.0.0.1"
KEEP_ALIVE = 15.0
"""Seconds between two signs of life of server-sent events; they reveal that a page is closed."""
_GRACE = 2.0
"""Seconds that the server may take to end."""


class LocalServer(ThreadingHTTPServer):
    """Server that ends without waiting for its pages."""

    daemon_threads = True
    block_on_close = False
    request_queue_size = 128

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Tell what went wrong, unless the client has only left."""
        if not isinstance(sys.exc_info()[1], ConnectionError):
            super().handle_error(request, client_address)


class LocalHandler(BaseHTTPRequestHandler):
    """Answers to pages of this computer; `policy` is that of all answers."""

    policy = "default-src 'none'"
    # A client that neither asks nor listens gives its thread back.
    timeout = 2 * KEEP_ALIVE

    def do_GET(self) -> None:
        """Answer a page of this computer, and no other."""
        if self.is_local():
            self.answer_page()
        else:
            self.send_error(HTTPStatus.FORBIDDEN)

    def do_POST(self) -> None:
        """Answer JSON from a page of this computer."""
        # Browsers let no foreign page send JSON without a preflight, which is not answered.
        is_own = self.headers.get("Origin") in (None, f"http://{self.headers.get('Host')}")
        is_json = self.headers.get("Content-Type") == "application/json"
        if self.is_local() and is_own and is_json:
            self.answer_command()
        else:
            self.send_error(HTTPStatus.FORBIDDEN)

    def answer_page(self) -> None:
        """Answer a request of a page of this computer."""
        raise NotImplementedError

    def answer_command(self) -> None:
        """Answer what a page of this computer wants to be done, which is in JSON."""
        self.send_error(HTTPStatus.FORBIDDEN)

    def is_local(self) -> bool:
        """Return True unless the host name points to a foreign domain (DNS rebinding)."""
        return (self.headers.get("Host") or "").partition(":")[0] in (HOST, "localhost")

    def begin(self, type_: str) -> None:
        """Send the head of an answer."""
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", f"{type_}; charset=utf-8")
        self.send_header("Content-Security-Policy", self.policy)
        self.send_header("Cache-Control", "no-store")
        self.end_headers()

    def send_events(self, batches: Iterable[Sequence[Mapping[str, object]]]) -> None:
        """Send server-sent events; an empty batch is a sign of life.

        Source: https://html.spec.whatwg.org (section 9.2).
        """
        self.begin("text/event-stream")
        try:
            for messages in batches:
                texts = [f"data: {json.dumps(each)}\n\n" for each in messages]
                self.wfile.write("".join(texts or [": still here\n\n"]).encode())
                self.wfile.flush()
        except OSError:
            pass  # the page was closed

    def log_message(self, *_: object) -> None:
        """Suppress the request log."""


@contextmanager
def running(server: LocalServer) -> Iterator[str]:
    """Let a server answer while the context lasts; yield its address."""
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://{HOST}:{server.server_port}/"
    finally:
        ending = threading.Thread(target=server.shutdown, daemon=True)
        ending.start()
        ending.join(_GRACE)
        server.server_close()
