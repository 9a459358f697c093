"""Page of the player to which lines are added while a trace is written."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from http import HTTPStatus
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import OddFileError
from swarmdsl.execution.simulate.run.prepare import Prepared
from swarmdsl.ide.preview.local_server import (
    HOST,
    KEEP_ALIVE,
    LocalHandler,
    LocalServer,
    running,
)
from swarmdsl.ide.preview.trace_file import STDIN, Turn, read_growing
from swarmdsl.project.read_source import report_unreadable
from swarmdsl.tools.player.live_lines import LiveLines, Message
from swarmdsl.tools.player.model import Model
from swarmdsl.tools.player.page import page
from swarmdsl.tools.player.record import note_of, record_nothing

Tell = Callable[[Diagnostics], None]
_RENEWED: Message = {"turn": "renewed"}


class Feed:
    """Messages about a trace, which each page gets from the first one on."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._messages: list[Message] = []
        self._shown: Message | None = None
        """Message of which only the last counts."""
        self._trace = 0
        """Number of times that the trace began."""
        self._is_closed = False

    def add(self, message: Message) -> None:
        """Add a message for all pages."""
        with self._changed:
            self._messages.append(message)
            self._changed.notify_all()

    def show(self, message: Message) -> None:
        """Replace the message of which only the last counts; all pages get it."""
        with self._changed:
            self._shown = message
            self._changed.notify_all()

    def begin(self) -> None:
        """Begin a new trace: pages of the one before get no more of it."""
        with self._changed:
            self._messages = []
            self._trace += 1
            self._changed.notify_all()

    def close(self) -> None:
        """End for all pages."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()

    def follow(self) -> Iterator[Sequence[Mapping[str, object]]]:
        """Yield the messages for a page, now and when there are more; empty on a timeout."""
        trace, sent = self._trace, 0
        shown: Message | None = None

        def is_new() -> bool:
            is_other = trace != self._trace or shown is not self._shown
            return self._is_closed or is_other or len(self._messages) > sent

        while not self._is_closed:
            with self._changed:
                self._changed.wait_for(is_new, KEEP_ALIVE)
                if trace != self._trace and sent:
                    new = [_RENEWED]
                else:
                    trace = self._trace
                    new = self._messages[sent:]
                    sent += len(new)
                    if self._shown is not None and self._shown is not shown:
                        new = [*new, self._shown]
                    shown = self._shown
            yield new
            if new == [_RENEWED]:
                return


@contextmanager
def playing(prepared: Prepared | None, trace: str, port: int, tell: Tell) -> Iterator[str]:
    """Serve the page of a trace while the context lasts; yield its address.

    Port 0 selects a free port. `tell` reports invalid lines. Raises OSError if the port is taken.
    """
    server = _Server((HOST, port), _Handler)
    name = "standard input" if trace == STDIN else trace
    recording = record_nothing(prepared, name)
    server.feed, server.html = Feed(), page(recording).encode()
    model = Model(prepared.subject) if prepared is not None else None

    def begun() -> LiveLines:
        return LiveLines(name, model, recording.machines)

    with running(server) as address:
        reader = (trace, begun, server.feed, tell)
        threading.Thread(target=_read, args=reader, daemon=True).start()
        try:
            yield address
        finally:
            server.feed.close()


def _read(trace: str, begun: Callable[[], LiveLines], feed: Feed, tell: Tell) -> None:
    """Add what comes to the feed, to the end of the trace or forever."""
    lines = begun()
    try:
        for chunk in read_growing(trace):
            if chunk is Turn.BEGUN:
                lines = begun()
                feed.begin()
            elif isinstance(chunk, Turn):
                feed.add({"turn": chunk.value})
            else:
                report = Diagnostics()
                message = lines.read(chunk, report)
                if message:
                    feed.add(message)
                if len(report):
                    tell(report)
    except OddFileError as error:
        report = Diagnostics()
        report_unreadable(Path(trace), error, None, report, "a trace")
        feed.add({"notes": [note_of(each).head() for each in report]})
        tell(report)


class _Server(LocalServer):
    feed: Feed
    html: bytes


class _Handler(LocalHandler):
    server: _Server
    # The page says itself which scripts it has.
    policy = "base-uri 'none'; form-action 'none'"

    def answer_page(self) -> None:
        if self.path == "/events":
            self.send_events(self.server.feed.follow())
        elif self.path == "/":
            self.begin("text/html")
            self.wfile.write(self.server.html)
        else:
            self.send_error(HTTPStatus.NOT_FOUND)
