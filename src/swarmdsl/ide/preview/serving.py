"""Serves the page of a preview on the loopback interface, and tells it what is new."""

from __future__ import annotations

import json
import threading
from collections import deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import parse_qs

from swarmdsl.ide.preview.editors import Editor, Opened, file_of
from swarmdsl.ide.preview.pictures import Message, Pictures, Steps

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
# Moves of which a page that is slow to hear may still be told what was done.
_REMEMBERED = 100
_LONGEST = 1 << 16
"""Bytes of a message of a page, at most."""


class News:
    """What pages show: the pictures of the last model without errors, and what came after it."""

    def __init__(self) -> None:
        self.pictures = Pictures()
        self._changed = threading.Condition()
        self._messages: Sequence[Message] = ()
        # By traces: the innermost active states of members.
        self._active: dict[str, dict[str, Sequence[str]]] = {}
        self._moves = 0
        # The number of a move, and what was done in it.
        self._steps: deque[tuple[int, Steps]] = deque(maxlen=_REMEMBERED)

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

    def move(
        self,
        trace: str,
        active: Mapping[str, Sequence[str] | None],
        latest: Steps,
    ) -> None:
        """Show where members are now, of which a trace says so; None is for those that are gone.

        `latest` is what they have just done, for pages that are there to see it.
        """
        with self._changed:
            there = self._active.setdefault(trace, {})
            for member, states in active.items():
                if states is None:
                    there.pop(member, None)
                else:
                    there[member] = states
            self._moves += 1
            self._steps.append((self._moves, latest))
            self._changed.notify_all()

    def forget(self, trace: str) -> None:
        """Forget what a trace has said: it begins anew."""
        with self._changed:
            self._active.pop(trace, None)
            self._moves += 1
            self._changed.notify_all()

    def follow(self) -> Iterator[Sequence[Message]]:
        """Yield what a page needs, now and after each change; nothing where there was none."""
        sent: Sequence[Message] = ()
        active: dict[str, Sequence[str]] = {}
        moves = 0
        seen = self._moves

        def is_new() -> bool:
            return self._messages is not sent or self._moves != moves

        while True:
            with self._changed:
                self._changed.wait_for(is_new, _PULSE)
                new = [each for each in self._messages if not any(each is old for old in sent)]
                sent, moves = self._messages, self._moves
                steps = [step for number, step in self._steps if number > seen]
                seen = moves
                now = {who: at for trace in self._active.values() for who, at in trace.items()}
            moved: dict[str, Sequence[str] | None] = dict.fromkeys(active.keys() - now.keys())
            moved.update((who, at) for who, at in now.items() if active.get(who) is not at)
            active = now
            if moved:
                new.append({"active": moved})
            if done := _together(steps):
                new.append(done)
            yield new


def _together(steps: Iterable[Steps]) -> Message:
    """What was done in some steps; nothing of which there is none."""
    taken: dict[str, list[str]] = {}
    entered: dict[str, list[str]] = {}
    for step in steps:
        for who, ids in step.get("taken", {}).items():
            taken.setdefault(who, []).extend(ids)
        for who, ids in step.get("entered", {}).items():
            entered.setdefault(who, []).extend(ids)
    done: Message = {}
    if taken:
        done["taken"] = taken
    if entered:
        done["entered"] = entered
    return done


@contextmanager
def serving(news: News, port: int, editor: Editor | None = None) -> Iterator[str]:
    """Serve the page while the context lasts; yield its address. `port` 0 takes a free one.

    The editor shows what is clicked. Raises OSError if the port is taken.
    """
    server = _Server((_HOST, port), _Handler)
    server.news, server.editor = news, editor
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
    editor: Editor | None

    def opened(self, place: str) -> Opened:
        """Show a place of the model in the editor; nothing else is opened."""
        if self.editor is None:
            return {"none": True}
        if file_of(place) not in self.news.pictures.files:
            return {"failed": "this is no place in the model"}
        return self.editor.open(place)


class _Handler(BaseHTTPRequestHandler):
    server: _Server

    def do_GET(self) -> None:
        if not self._is_asked_here():
            self.send_error(HTTPStatus.FORBIDDEN)
            return
        if self.path == "/events":
            self._events()
            return
        path, _, query = self.path.partition("?")
        if path == "/picture":
            asked = parse_qs(query)
            drawn = self.server.news.pictures.drawn(asked.get("id", [""])[0], asked.get("fold", []))
            self._answer(drawn)
            return
        file = _FILES.get("/index.html" if path == "/" else path)
        if file is None:
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        self._begin(_TYPES[file.suffix])
        self.wfile.write(file.read_bytes())

    def do_POST(self) -> None:
        # A page of others may not send JSON here without asking before, which is not answered.
        is_json = self.headers.get("Content-Type") == "application/json"
        if not (self.path == "/open" and is_json and self._is_asked_here()):
            self.send_error(HTTPStatus.FORBIDDEN)
            return
        try:
            long = int(self.headers.get("Content-Length") or 0)
            place = json.loads(self.rfile.read(max(0, min(long, _LONGEST))))
        except (ValueError, RecursionError):
            place = None
        self._answer(self.server.opened(place if isinstance(place, str) else ""))

    def _is_asked_here(self) -> bool:
        """Not by a page of others that has a name of its own lead here."""
        return (self.headers.get("Host") or "").partition(":")[0] in (_HOST, "localhost")

    def _answer(self, value: Mapping[str, object]) -> None:
        self._begin("application/json")
        self.wfile.write(json.dumps(value).encode())

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
