"""System variables of a running document: `_event`, `_sessionid`, `_name`, `_ioprocessors`.

A session is made when a document first asks for it, so machines that never do pay nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import count
from typing import Any

from swarmdsl.execution.engine import Event, ExecutionError, Instance, InstanceLike
from swarmdsl.execution.engine.activity import Timer

PROCESSOR = "http://www.w3.org/TR/scxml/#SCXMLEventProcessor"
"""Type of the events that state machines send to each other (C.1)."""

_NUMBERS = count(1)
# Beginnings of names of events that the engine itself raises.
_PLATFORM = ("error.", "done.state.")


class RaisedEvent(Event):
    """Event of the internal queue that tells `_event` what the engine does not need to know.

    `kind` is its type, `internal` or `platform`; `sendid` is the id of the `<send>` behind it.
    """

    __slots__ = ("kind", "sendid")

    def __init__(self, name: str, data: Any, kind: str, sendid: str | None = None) -> None:
        super().__init__(name, data)
        self.kind = kind
        self.sendid = sendid


class Session(dict[str, Any]):
    """Variables of an instance, and the rest of what its document can ask for.

    `bound` has the variables of late binding with a value, `turns` is the number of turns that
    its loops may still take in this block.
    """

    __slots__ = ("_current", "_fields", "_sends", "bound", "id", "processors", "turns")

    def __init__(self, variables: Mapping[str, Any]) -> None:
        super().__init__(variables)
        self.id = f"session{next(_NUMBERS)}"
        self.processors = {name: {"location": self.location} for name in (PROCESSOR, "scxml")}
        self.bound: set[str] = set()
        self.turns = 0
        self._sends = count(1)
        self._current: Event | None = None
        self._fields: dict[str, Any] = {}

    @property
    def location(self) -> str:
        """Target of events to this session."""
        return f"#_scxml_{self.id}"

    def next_sendid(self) -> str:
        """Return an id for a `<send>` without one."""
        return f"{self.id}.send{next(self._sends)}"

    def fields(self, event: Event) -> dict[str, Any]:
        """Return the object `_event`, the same one as long as the event is the current one."""
        if self._current is not event:
            self._current = event
            self._fields = self._described(event)
        return self._fields

    def _described(self, event: Event) -> dict[str, Any]:
        kind, sendid, origin = "external", None, None
        if isinstance(event, RaisedEvent):
            kind, sendid = event.kind, event.sendid
        elif isinstance(event.origin, Timer):
            sendid, origin = event.origin.id or None, self.location
        elif event.name.startswith(_PLATFORM):
            kind = "platform"
        else:
            origin = event.envelope.sender or None
        values = (event.name, kind, sendid, origin, PROCESSOR if origin else None, None, event.data)
        return dict(zip(EVENT_FIELDS, values, strict=True))


EVENT_FIELDS = ("name", "type", "sendid", "origin", "origintype", "invokeid", "data")
"""Fields of `_event` (5.10.1)."""


def session_of(instance: InstanceLike) -> Session:
    """Return the session of an instance; it takes the place of the plain variables."""
    if not isinstance(instance.data, Session):
        instance.data = Session(instance.data)
    found: Session = instance.data
    return found


def event_fields(instance: InstanceLike, event: Event) -> dict[str, Any]:
    """Return the object `_event`; raises ExecutionError before the first event."""
    if not event.name:
        raise ExecutionError("`_event` is not defined")
    return session_of(instance).fields(event)


def report_failure(
    instance: InstanceLike, error: Exception, name: str, sendid: str | None = None
) -> None:
    """Report an error like the engine, but with the id of the `<send>` that failed."""
    assert isinstance(instance, Instance)
    instance.world.failed(instance, error)
    instance.raise_event(RaisedEvent(name, str(error), "platform", sendid))


SYSTEM_VARIABLES: Mapping[str, Callable[[InstanceLike, Event], Any]] = {
    "_event": event_fields,
    "_ioprocessors": lambda instance, event: session_of(instance).processors,
    "_name": lambda instance, event: instance.machine.name,
    "_sessionid": lambda instance, event: session_of(instance).id,
}
"""Values of the variables that a document can read, but not assign (5.10)."""
