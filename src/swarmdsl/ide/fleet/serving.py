"""Local server of the page of a fleet; with a token, also for other computers."""

from __future__ import annotations

import hmac
import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs

from swarmdsl.ide.fleet.watch import NotSentError, Watch
from swarmdsl.ide.preview.local_server import HOST, LocalHandler, LocalServer, running
from swarmdsl.tools.player.page import page

_MAX_BODY = 1 << 16
"""Maximum length of what a page sends, in bytes."""
_COOKIE = "swarmc_fleet_{port}"


@contextmanager
def serving(watch: Watch, host: str, port: int, token: str | None) -> Iterator[str]:
    """Serve the page while the context lasts; yield its address, with the token if there is one.

    Port 0 selects a free port. Raises OSError if the port is taken.
    """
    server = _Server((host, port), _Handler)
    server.watch, server.token = watch, token
    server.html = page(watch.recording()).encode()
    with running(server) as address:
        named = address if host == HOST else f"http://{host}:{server.server_port}/"
        try:
            yield f"{named}?token={token}" if token is not None else named
        finally:
            watch.feed.close()


class _Server(LocalServer):
    watch: Watch
    token: str | None
    html: bytes


class _Handler(LocalHandler):
    """Answers to those who have the token, or without one to pages of this computer."""

    server: _Server
    # The page says itself which scripts it has. No other page shows it around its buttons.
    policy = "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"

    def is_local(self) -> bool:
        """Return True for a request of no foreign page, with the token if there is one."""
        origin = self.headers.get("Origin")
        if origin is not None and origin != f"http://{self.headers.get('Host')}":
            return False
        if self.server.token is None:
            return super().is_local()
        given = self._tokens()
        return any(hmac.compare_digest(each.encode(), self.server.token.encode()) for each in given)

    def answer_page(self) -> None:
        path, _, query = self.path.partition("?")
        if path == "/" and query and self.server.token is not None:
            self._remember()
        elif path == "/events":
            self.send_events(self.server.watch.feed.follow())
        elif path == "/":
            self.begin("text/html")
            self.wfile.write(self.server.html)
        else:
            self.send_error(HTTPStatus.NOT_FOUND)

    def answer_command(self) -> None:
        if self.path != "/send":
            self.send_error(HTTPStatus.FORBIDDEN)
            return
        try:
            length = int(self.headers.get("Content-Length") or 0)
            asked = json.loads(self.rfile.read(max(0, min(length, _MAX_BODY))))
        except (ValueError, RecursionError):
            asked = None
        answer = json.dumps(self._sent(asked)).encode()
        self.begin("application/json")
        self.wfile.write(answer)

    def _sent(self, asked: Any) -> Mapping[str, object]:
        """Send what a page asks for; return what became of it."""
        if not isinstance(asked, dict) or not isinstance(asked.get("event"), str):
            return {"failed": "this is no event"}
        fields = asked.get("data") or {}
        if not isinstance(fields, dict):
            return {"failed": "`data` has the fields of a message"}
        try:
            heard, lost = self.server.watch.send(asked["event"], fields)
            return {"heard": heard, "lost": lost}
        except NotSentError as error:
            return {"failed": str(error)}

    def _tokens(self) -> Iterator[str]:
        """Yield the tokens that a request has: in its address, as a cookie or in a header."""
        yield from parse_qs(self.path.partition("?")[2]).get("token", [])
        yield (self.headers.get("Authorization") or "").removeprefix("Bearer ")
        try:
            cookies = SimpleCookie(self.headers.get("Cookie") or "")
        except CookieError:
            return
        if (found := cookies.get(self._cookie)) is not None:
            yield found.value

    def _remember(self) -> None:
        """Move the token from the address, which others may see, to a cookie."""
        self.send_response(HTTPStatus.SEE_OTHER)
        self.send_header("Location", "/")
        cookie = f"{self._cookie}={self.server.token}; Path=/; HttpOnly; SameSite=Strict"
        self.send_header("Set-Cookie", cookie)
        self.send_header("Referrer-Policy", "no-referrer")
        self.end_headers()

    @property
    def _cookie(self) -> str:
        return _COOKIE.format(port=self.server.server_port)
