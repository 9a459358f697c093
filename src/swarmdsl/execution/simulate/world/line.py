"""Line of a trace: the effects of one event, as JSON and as text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import NO_ENVELOPE, Envelope, Transition
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.scenario.space import Place

EMPTY = '""'
"""Address of nobody: an empty string."""
LATE = "fault.late."
"""Trace event of a missed deadline, before the name of the event."""


@dataclass(slots=True)
class Line:
    """Effects of one event; `event` is None for the start, states are given as ids.

    `ignored` is True for an event that enables no transition, `deferred` for one that is kept, and
    `recalled` when a kept one is processed; `dropped` are deferred events that were forgotten.
    `scheduled` has the events that will be sent, with address and delay, `withdrawn` the cancelled
    ones.

    `data` and `envelope` belong to the event, `messages` and `addresses` to the events in
    `sent`; `nobody` are the indices of those whose address no other robot has. `at` is where the
    robot is after it, in a space with places.
    """

    time: int
    actor: Actor
    event: str | None
    configuration: list[str] = field(default_factory=list)
    entered: list[str] = field(default_factory=list)
    exited: list[str] = field(default_factory=list)
    started: list[str] = field(default_factory=list)
    cancelled: list[str] = field(default_factory=list)
    sent: list[str] = field(default_factory=list)
    messages: list[Any] = field(default_factory=list)
    addresses: list[str | None] = field(default_factory=list)
    nobody: list[int] = field(default_factory=list)
    taken: list[Transition] = field(default_factory=list)
    ignored: bool = False
    deferred: bool = False
    recalled: bool = False
    dropped: list[str] = field(default_factory=list)
    scheduled: list[tuple[str, str | None, int]] = field(default_factory=list)
    withdrawn: list[str] = field(default_factory=list)
    data: Any = None
    envelope: Envelope = NO_ENVELOPE
    at: Place | None = None


def as_json(line: Line, more: Mapping[str, Any] | None = None) -> str:
    """Format a line as JSON, with more keys at its end; times are in whole milliseconds."""
    called = line.actor.machine.called
    values: dict[str, Any] = {
        "t": line.time // MILLISECOND,
        "member": line.actor.name,
        "event": line.event,
        "configuration": line.configuration,
        "entered": line.entered,
        "exited": line.exited,
        "taken": list(dict.fromkeys(map(called, line.taken))),
        "started": line.started,
        "cancelled": line.cancelled,
        "sent": line.sent,
    }
    for key in ("ignored", "deferred", "recalled"):
        if getattr(line, key):
            values[key] = True
    if line.dropped:
        values["dropped"] = line.dropped
    if line.scheduled:
        values["scheduled"] = [
            {"event": name, "to": to, "after": delay // MILLISECOND}
            for name, to, delay in line.scheduled
        ]
    if line.withdrawn:
        values["withdrawn"] = line.withdrawn
    if line.data:
        values["data"] = named_numbers(line.data)
    if line.envelope.sender:
        values["envelope"] = {"sender": line.envelope.sender, "sent": line.envelope.sent}
    if any(address is not None for address in line.addresses):
        values["to"] = line.addresses
    if line.nobody:
        values["nobody"] = [line.sent[number] for number in line.nobody]
    if line.at is not None:
        values["at"] = [round(each, 3) for each in line.at]
    values.update(more or {})
    return json.dumps(values, ensure_ascii=False, default=str, allow_nan=False)


def as_text(line: Line, width: int = 0) -> str:
    """Format a line as text: time, member, event, new states and actions.

    The event may be `(ignored)`, because it enables no transition, `(deferred)` or `(recalled)`.
    Member names are padded to `width`.
    """
    who = f"{line.actor.name:<{width}}  " if line.actor.name is not None else ""
    head = f"{line.time / SECOND:>10.3f}  {who}{line.event or '(start)'}"
    if line.event == LOST and line.data:
        head += f" ({line.data['reason']})"
    changed = bool(line.entered or line.exited)
    fates = {
        "recalled": line.recalled,
        "deferred": line.deferred,
        "ignored": line.ignored and not changed,
    }
    if any(fates.values()):
        head += f" ({', '.join(word for word, is_so in fates.items() if is_so)})"
    if changed:
        head += f" -> {', '.join(line.configuration)}"
    sent = [_sent(line, number) for number in range(len(line.sent))]
    sent += [f"{_addressed(name, to)} after {_time(wait)}" for name, to, wait in line.scheduled]
    cancelled = [*line.cancelled, *(f"send {name}" for name in line.withdrawn)]
    done = (
        ("start", line.started),
        ("cancel", cancelled),
        ("send", sent),
        ("drop", line.dropped),
    )
    words = [f"{word} {', '.join(names)}" for word, names in done if names]
    return "; ".join([head, *words])


def _time(delay: int) -> str:
    """Return a delay in seconds: `2.5 s`."""
    return f"{delay / SECOND:g} s"


def _addressed(name: str, address: str | None) -> str:
    return name if address is None else f"{name} to {address or EMPTY}"


def _sent(line: Line, number: int) -> str:
    """Describe a sent event, with its address."""
    name, address = line.sent[number], line.addresses[number]
    nobody = " (nobody)" if number in line.nobody else ""
    return f"{_addressed(name, address)}{nobody}"
