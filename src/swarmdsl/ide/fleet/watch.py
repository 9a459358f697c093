"""Watch over a fleet: lines of its traces for pages, and the standing of its robots."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from queue import SimpleQueue
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.ide.fleet.operator_events import OperatorEvent, operator_events
from swarmdsl.ide.fleet.standing import Standing
from swarmdsl.ide.preview.live_player import Feed
from swarmdsl.ide.preview.trace_file import Turn
from swarmdsl.tools.player.live_lines import LiveLines
from swarmdsl.tools.player.model import Model
from swarmdsl.tools.player.recording import Recording

Tell = Callable[[Diagnostics], None]
Head = dict[str, Any]
"""Standing of the robots as plain data."""
Sent = tuple[int, list[str]]
"""Number of nodes that listen to an event, and the robots that are lost: they may not hear it."""
Send = Callable[[OperatorEvent, Mapping[str, Any]], int]
"""Sends an event with the given fields; returns how many nodes listen. Raises NotSentError."""
_PATIENCE = 1000
"""Milliseconds by which a line may come later than another one, on its way from the robot."""
RECORDED = "a recording hears nothing"
FOLLOWED = "robots of a trace hear nothing: follow them with `ros2:NAME`"


class NotSentError(Exception):
    """An event is not sent; the message names the reason."""


class Watch:
    """State of a fleet as far as it is known: sources add to it, pages and terminals show it.

    `no_sending` is the reason why nothing can be sent, until a source gives a way to do it;
    `waiting` tells of a trace that is not there yet. If `tells_each`, `changes` gets the standing
    after each line that changes it, and None at the end of a trace.
    """

    def __init__(
        self,
        name: str,
        subject: Subject | None,
        recording: Recording,
        tell: Tell,
        clock: Callable[[], float] = time.monotonic,
        no_sending: str = FOLLOWED,
        tells_each: bool = False,
    ) -> None:
        self.feed = Feed()
        self.events = operator_events(subject)
        self.no_sending = no_sending
        self.waiting = ""
        self.changes: SimpleQueue[Head | None] | None = SimpleQueue() if tells_each else None
        self._tell = tell
        self._lock = threading.RLock()
        model = Model(subject) if subject is not None else None

        def begun() -> tuple[LiveLines, Standing]:
            lines = LiveLines(name, model, recording.machines, _PATIENCE)
            return lines, Standing(subject, clock)

        self._begun = begun
        self._lines, self._standing = begun()
        self._told: Head = {}
        self._send: Send | None = None
        self._recording = recording

    # ---- for sources

    def read(self, lines: Iterable[str | bytes]) -> None:
        """Add more complete lines of traces."""
        report = Diagnostics()
        with self._lock:
            for part in [lines] if self.changes is None else ([line] for line in lines):
                message = self._lines.read(part, report)
                self._standing.read(message.get("lines", ()))
                if message:
                    self.feed.add(message)
                self._publish()
        if len(report):
            self._tell(report)

    def begin_again(self) -> None:
        """Begin a new trace."""
        with self._lock:
            self.waiting = ""
            self._lines, self._standing = self._begun()
            self.feed.begin()
            self._publish()

    def turn(self, what: str) -> None:
        """Tell what becomes of the trace."""
        self.feed.add({"turn": what})
        if self.changes is not None and what == Turn.ENDED.value:
            self.changes.put(None)

    @contextmanager
    def noting(self) -> Iterator[Standing]:
        """Let a source note something; what has changed is told."""
        with self._lock:
            yield self._standing
            self._publish()

    def send_with(self, send: Send) -> None:
        """Send events so from now on."""
        self._send, self.no_sending = send, ""

    # ---- for pages and terminals

    def recording(self) -> Recording:
        """Return what a page shows before the first line."""
        with self._lock:
            head = {
                "events": [each.head() for each in self.events],
                "refused": self.no_sending,
                "now": self._standing.head(),
            }
        return replace(self._recording, views={**self._recording.views, "fleet": head})

    def head(self) -> Head:
        """Return the standing of the robots as it is now."""
        with self._lock:
            return self._standing.head()

    def send(self, name: str, fields: Mapping[str, Any]) -> Sent:
        """Send an event to the robots; raise NotSentError if it cannot be."""
        event = next((each for each in self.events if each.name == name), None)
        if event is None:
            raise NotSentError(f"no person may send `{name}`: declare it as `swarm operator event`")
        if self._send is None:
            raise NotSentError(self.no_sending)
        heard = self._send(event, fields)
        with self.noting() as standing:
            standing.note_sent(name, heard)
            return heard, standing.lost()

    def _publish(self) -> None:
        head = self._standing.head()
        if head != self._told:
            self._told = head
            self.feed.show({"fleet": head})
            if self.changes is not None:
                self.changes.put(head)
