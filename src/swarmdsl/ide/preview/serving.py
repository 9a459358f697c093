"""Local HTTP server of the preview page, with server-sent events."""

from __future__ import annotations

import json
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from http import HTTPStatus
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs

from swarmdsl.base.read_files import read_file
from swarmdsl.ide.preview.editors import Editor, OpenResult, file_of
from swarmdsl.ide.preview.local_server import (
    HOST,
    KEEP_ALIVE,
    LocalHandler,
    LocalServer,
    running,
)
from swarmdsl.ide.preview.pictures import Message, Pictures, Steps

PAGE = Path(__file__).resolve().parent / "page"
_TYPES = {".html": "text/html", ".css": "text/css", ".js": "text/javascript"}
_FILES = {f"/{path.name}": path for path in PAGE.iterdir() if path.suffix in _TYPES}
# The page runs only its own scripts and fetches nothing else.
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
    "connect-src 'self'; img-src blob: data:"
)
# Number of recent updates kept for slow pages.
_HISTORY = 100
_MAX_BODY = 1 << 16
"""Maximum length of a POST body in bytes."""
Act = Callable[[Any], str]


class Snapshot:
    """Current state of the preview: diagrams of the last valid model, errors, live states."""

    def __init__(self) -> None:
        self.pictures = Pictures()
        self._changed = threading.Condition()
        self._messages: Sequence[Message] = ()
        self._debug: Message | None = None
        # Innermost active states of members by trace.
        self._active: dict[str, dict[str, Sequence[str]]] = {}
        self._moves = 0
        # Number of the last change, and the last one that each page has been sent.
        self._changes = 0
        self._delivered: dict[object, int] = {}
        # Update number and the steps in it.
        self._steps: deque[tuple[int, Steps]] = deque(maxlen=_HISTORY)

    def tell(self, update: Pictures | Message, offers: Message | None = None) -> None:
        """Publish diagrams or a message to all pages; with diagrams, what can be simulated."""
        with self._changed:
            if isinstance(update, Pictures):
                self.pictures = update
                self._messages = ({**update.listed(), **(offers or {})},)
            else:
                # Keep the diagrams; only the last error count matters.
                self._messages = (*(each for each in self._messages if "titles" in each), update)
            self._notify()

    def control(self, message: Message) -> None:
        """Publish the state of the simulation that pages drive."""
        with self._changed:
            self._debug = message
            self._notify()

    def move(
        self,
        trace: str,
        active: Mapping[str, Sequence[str] | None],
        latest: Steps,
    ) -> None:
        """Publish active states of members of a trace; None for members that ended.

        `latest` are steps of the last moment, only for pages that are open.
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
            self._notify()

    def forget(self, trace: str) -> None:
        """Drop the states of a trace that restarts."""
        with self._changed:
            self._active.pop(trace, None)
            self._moves += 1
            self._notify()

    def wait_for_page(self, seconds: float) -> bool:
        """Wait until somebody looks at a page; return False if that takes too long."""
        with self._changed:
            return self._changed.wait_for(lambda: bool(self._delivered), seconds)

    def wait_for_delivery(self, seconds: float) -> None:
        """Wait until all pages have been sent the last change, unless that takes too long."""
        with self._changed:
            self._changed.wait_for(
                lambda: all(each == self._changes for each in self._delivered.values()), seconds
            )

    def _notify(self) -> None:
        self._changes += 1
        self._changed.notify_all()

    def follow(self) -> Iterator[Sequence[Message]]:
        """Yield the messages for a page, now and after each change; empty on a timeout."""
        page = object()
        try:
            yield from self._follow(page)
        finally:
            with self._changed:
                self._delivered.pop(page, None)
                self._changed.notify_all()

    def _follow(self, page: object) -> Iterator[Sequence[Message]]:
        sent: Sequence[Message] = ()
        active: dict[str, Sequence[str]] = {}
        debug: Message | None = None
        moves = changes = 0
        seen = self._moves

        def is_new() -> bool:
            is_told = self._messages is sent and self._debug is debug
            return not is_told or self._moves != moves

        while True:
            with self._changed:
                # Whoever comes back has sent what it was given.
                self._delivered[page] = changes
                self._changed.notify_all()
                self._changed.wait_for(is_new, KEEP_ALIVE)
                new = [each for each in self._messages if not any(each is old for old in sent)]
                if self._debug is not None and self._debug is not debug:
                    new.append(self._debug)
                debug = self._debug
                sent, moves, changes = self._messages, self._moves, self._changes
                steps = [step for number, step in self._steps if number > seen]
                seen = moves
                now = {
                    member: at for trace in self._active.values() for member, at in trace.items()
                }
            moved: dict[str, Sequence[str] | None] = dict.fromkeys(active.keys() - now.keys())
            moved.update(
                (member, states)
                for member, states in now.items()
                if active.get(member) is not states
            )
            active = now
            if moved:
                new.append({"active": moved})
            if done := _merged(steps):
                new.append(done)
            yield new


def _merged(steps: Iterable[Steps]) -> Message:
    """Merge steps; omit empty keys."""
    taken: dict[str, list[str]] = {}
    entered: dict[str, list[str]] = {}
    for step in steps:
        for member, ids in step.get("taken", {}).items():
            taken.setdefault(member, []).extend(ids)
        for member, ids in step.get("entered", {}).items():
            entered.setdefault(member, []).extend(ids)
    done: Message = {}
    if taken:
        done["taken"] = taken
    if entered:
        done["entered"] = entered
    return done


@contextmanager
def serving(
    snapshot: Snapshot, port: int, editor: Editor | None = None, act: Act | None = None
) -> Iterator[str]:
    """Serve the page while the context lasts; yield its address.

    Port 0 selects a free port. `editor` opens clicked places, `act` does what a page wishes of a
    simulation and returns why it does not. Raises OSError if the port is taken.
    """
    server = _Server((HOST, port), _Handler)
    server.snapshot, server.editor, server.act = snapshot, editor, act
    with running(server) as address:
        yield address


class _Server(LocalServer):
    snapshot: Snapshot
    editor: Editor | None
    act: Act | None

    def open_place(self, place: str) -> OpenResult:
        """Open a place of the model in the editor; reject all other places."""
        if self.editor is None:
            return {"none": True}
        if file_of(place) not in self.snapshot.pictures.files:
            return {"failed": "not a place in the model"}
        return self.editor.open(place)


class _Handler(LocalHandler):
    server: _Server
    policy = _POLICY

    def answer_page(self) -> None:
        if self.path == "/events":
            self.send_events(self.server.snapshot.follow())
            return
        path, _, query = self.path.partition("?")
        if path == "/picture":
            asked = parse_qs(query)
            drawn = self.server.snapshot.pictures.drawn(
                asked.get("id", [""])[0], asked.get("fold", [])
            )
            self._answer(drawn)
            return
        file = _FILES.get("/index.html" if path == "/" else path)
        if file is None:
            self.send_error(HTTPStatus.NOT_FOUND)
            return
        self.begin(_TYPES[file.suffix])
        self.wfile.write(read_file(file))

    def answer_command(self) -> None:
        act = self.server.act
        if self.path == "/open":
            place = self._body()
            self._answer(self.server.open_place(place if isinstance(place, str) else ""))
        elif self.path == "/simulate" and act is not None:
            why = act(self._body())
            self._answer({"failed": why} if why else {})
        else:
            self.send_error(HTTPStatus.FORBIDDEN)

    def _body(self) -> Any:
        """Return the JSON of the request; None if it is none."""
        try:
            length = int(self.headers.get("Content-Length") or 0)
            return json.loads(self.rfile.read(max(0, min(length, _MAX_BODY))))
        except (ValueError, RecursionError):
            return None

    def _answer(self, value: Mapping[str, object]) -> None:
        self.begin("application/json")
        self.wfile.write(json.dumps(value).encode())
