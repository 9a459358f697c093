"""Serves the page of a preview on the loopback interface, and tells it what is new."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import unquote

from swarmdsl.preview.pictures import Message, Pictures

PAGE = Path(__file__).resolve().parent / "page"
_HOST = "127.0.0.1"
_TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript"}
_FILES = {f"/{path.name}": path for path in PAGE.iterdir() if path.suffix in _TYPES}
# Nothing but the page itself runs in it or is fetched by it.
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self'; img-src blob: data:"
)
# After so many seconds without news a connection is tried, to notice that a page is gone.
_PULSE = 15.0


class News:
    """What pages show: the pictures of the last model without errors, and what came after it."""

    def __init__(self) -> None:
        self.pictures = Pictures(())
        self._changed = threading.Condition()
        self._messages: Sequence[Message] = ()

    def tell(self, made: Pictures | Message) -> None:
        """Show something in all pages."""
        with self._changed:
            if isinstance(made, Pictures):
                self.pictures = made
                self._messages = (made.listed(),)
            else:
                # Of mistakes the last count, beside the pictures from before them.
                self._messages = (*(each for each in self._messages if "titles" in each), made)
            self._changed.notify_all()

    def follow(self) -> Iterator[Sequence[Message]]:
        """Yield what a page needs, now and after each change; nothing where there was none."""
        sent: Sequence[Message] = ()
        while True:
            with self._changed:
                self._changed.wait_for(lambda sent=sent: self._messages is not sent, _PULSE)  # type: ignore[misc]
                new = [each for each in self._messages if not any(each is old for old in sent)]
                sent = self._messages
            yield new


@contextmanager
def serving(news: News, port: int) -> Iterator[str]:
    """Serve the page while the context lasts; yield its address. `port` 0 takes a free one.

    Raises OSError if the port is taken.
    """
    server = _Server((_HOST, port), _Handler)
    server.news = news
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://{_HOST}:{server.server_port}/"
    finally:
        server.shutdown()
        server.server_close()


class _Server(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    news: News


class _Handler(BaseHTTPRequestHandler):
    server: _Server

    def do_GET(self) -> None:
        # A page of others that has a name lead here is not answered.
        host = (self.headers.get("Host") or "").rpartition(":")[0]
        if host not in (_HOST, "localhost"):
            self.send_error(HTTPStatus.FORBIDDEN)
            return
        if self.path == "/events":
            self._events()
            return
        path, _, query = self.path.partition("?")
        if path == "/picture":
            self._begin("application/json")
            drawn = self.server.news.pictures.drawn(unquote(query))
            self.wfile.write(json.dumps(drawn).encode())
            return
        file = _FILES.get("/index.html" if path == "/" else path)
        if file is None:
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        self._begin(_TYPES[file.suffix])
        self.wfile.write(file.read_bytes())

    def _begin(self, type_: str) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", f"{type_}; charset=utf-8")
        self.send_header("Content-Security-Policy", _POLICY)
        self.send_header("Cache-Control", "no-store")
        self.end_headers()

    def _events(self) -> None:
        """Server-sent events, as HTML has them: https://html.spec.whatwg.org (section 9.2)."""
        self._begin("text/event-stream")
        try:
            for messages in self.server.news.follow():
                texts = [f"data: {json.dumps(each)}\n\n" for each in messages]
                self.wfile.write("".join(texts or [": still here\n\n"]).encode())
                self.wfile.flush()
        except OSError:
            pass  # the page is gone

    def log_message(self, *_: object) -> None:
        """Say nothing: what is asked for is no news to the user."""
