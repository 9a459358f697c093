"""The element `<send>`: events to the machine itself, and to the environment.

A target or type that no event can be sent to is an error when the event is sent, as in SCXML, so
that a document can handle it.
"""

from __future__ import annotations

from swarmdsl.execution.engine import Effect, Envelope, Event, ExecutionError, InstanceLike
from swarmdsl.execution.engine.world import FAILURES
from swarmdsl.execution.scxml.attributes import Attributes
from swarmdsl.execution.scxml.document import Node
from swarmdsl.execution.scxml.ecmascript import location
from swarmdsl.execution.scxml.grammar import Unreadable
from swarmdsl.execution.scxml.session import (
    PROCESSOR,
    RaisedEvent,
    report_failure,
    session_of,
)
from swarmdsl.execution.scxml.values import copied
from swarmdsl.execution.scxml.vocabulary import SWARM_EVENT

_INTERNAL = "#_internal"
_HERE = ("", PROCESSOR, "scxml")
"""Types that mean a state machine."""

_HTTP = ("BasicHTTPEventProcessor", "basichttp")


class FailedSend(Exception):  # noqa: N818 - the error itself has been reported
    """A `<send>` failed and its error was raised: the rest of the block is skipped."""


def send(node: Node, attributes: Attributes) -> Effect:
    """Return the effect of a `<send>`."""
    _check_type(node, attributes)
    name = attributes.text(node, "event")
    target = attributes.text(node, "target")
    kind = attributes.text(node, "type")
    data = attributes.data(node)
    delay = attributes.delay(node)
    is_addressed = node.get("target") is not None or node.get("targetexpr") is not None
    given = node.get("id") or ""
    store = None
    if node.get("idlocation") is not None:
        try:
            store = location(node.get("idlocation") or "")
        except Unreadable as error:
            attributes.invalid(node, "idlocation", error)

    def effect(instance: InstanceLike, event: Event) -> None:
        sendid = given
        try:
            if store is not None:
                sendid = given or session_of(instance).next_sendid()
                store(instance, event, sendid)
            named = name(instance, event)
            if not named:
                raise ExecutionError("an event without a name cannot be sent")
            content = copied(data(instance, event)) if data is not None else None
            length = delay(instance, event) if delay is not None else 0
            place, type_ = target(instance, event), kind(instance, event)
            if length > 0 and place == _INTERNAL:
                raise ExecutionError(f"`{named}` has a target of its own: it cannot be delayed")
            if type_ == SWARM_EVENT:
                address = Envelope(to=place if is_addressed else None)
                made = Event(named, content, envelope=address)
                if delay is None:
                    instance.emit(made)
                else:
                    instance.emit_after(made, length, sendid)
            elif type_ not in _HERE:
                raise ExecutionError(f"no event can be sent with the type `{type_}`")
            elif not place or place == _own_location(instance, place):
                instance.send_after(Event(named, content), length, sendid)
            elif place == _INTERNAL:
                instance.raise_event(RaisedEvent(named, content, "internal", sendid or None))
            elif place.startswith("#_"):
                # The block goes on: such events are dispatched after it (6.2.4).
                lost = ExecutionError(f"`{named}` cannot reach `{place}`")
                report_failure(instance, lost, "error.communication", sendid or None)
            else:
                raise ExecutionError(f"no event can be sent to `{place}`")
        except FAILURES as error:
            report_failure(instance, error, "error.execution", sendid or None)
            raise FailedSend from error

    return effect


def _own_location(instance: InstanceLike, place: str) -> str | None:
    """Return the target that means the machine itself, if the place looks like one."""
    return session_of(instance).location if place.startswith("#_scxml_") else None


def _check_type(node: Node, attributes: Attributes) -> None:
    """Report events over HTTP, whose answer a document would wait for in vain."""
    if any(word in (node.get("type") or "") for word in _HTTP):
        place = attributes.document.at(node, "type")
        reason = "no event is sent over a network"
        attributes.report.report("not-understood", place, name="type", reason=reason)
