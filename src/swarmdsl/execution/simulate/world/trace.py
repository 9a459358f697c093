"""Trace of a run, one line per macrostep."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import (
    NO_ENVELOPE,
    Envelope,
    Event,
    Instance,
    InstanceLike,
    Observer,
    Run,
    State,
    Transition,
)
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.scenario.space import Place
from swarmdsl.execution.simulate.world.statistics import Life, Statistics


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


Audience = tuple[Robot, list[Life]]
"""Robot with the instances that listen to an event."""


class ReportingLife(Life):
    """Statistics of one instance that also make lines of their own."""

    __slots__ = ("arrived", "begun")

    arrived: Event | None
    """Event that it processes, if `begun` has nothing newer."""
    begun: tuple[str | None, Any, Envelope]
    """Name, data and envelope of an event, or None for the start."""

    def end(self) -> None:
        """End the macrostep."""

    def reaches_nobody(self) -> None:
        """Note that no other robot has the address of the last sent event."""


class Trace(Observer):
    """Build trace lines, and pass each to the listeners after the macrostep.

    Without listeners, instances are observed by their statistics alone. With reporters, these also
    make lines of what matters to the monitors.
    """

    def __init__(
        self,
        clock: Clock,
        listeners: Sequence[Callable[[Line], None]],
        place: Callable[[Robot], Place | None] = lambda robot: None,
    ) -> None:
        self._place = place
        self.statistics = Statistics()
        self.lives: dict[InstanceLike, Life] = {}
        self._clock = clock
        self._listeners = listeners
        self._line: Line | None = None
        self.observer: Observer = self
        """Observer of the instances while there are listeners; it passes everything on to this."""
        self.reporting: ReportingLife | None = None
        """Reporter of the instance that processes an event."""
        self.spread: Callable[[Event, Robot, Iterable[Audience]], None] | None = None
        """Let other robots with reporters process an event; None if there are no reporters."""

    def watch(self, instance: Instance, actor: Actor) -> None:
        """Observe an instance."""
        self.lives[instance] = Life(instance, actor, self._clock, self.statistics)
        instance.observer = self

    def replace(self, instance: Instance, by: Instance) -> None:
        """Observe the instance of a machine that starts anew instead of the one before."""
        life = self.lives[by] = self.lives.pop(instance)
        life.revive(by)
        by.observer = self.observer if self.is_heard else life

    def attach(self) -> None:
        """Begin the trace; there are no more listeners or reporters to come."""
        for life in self.lives.values():
            life.instance.observer = self.observer if self.is_heard else life

    @property
    def is_heard(self) -> bool:
        """True if there are listeners."""
        return bool(self._listeners)

    def count_anew(self) -> None:
        """Forget how many events have come at this point in time."""
        for life in self.lives.values():
            life.count_anew()

    def begin(
        self,
        instance: InstanceLike,
        event: str | None,
        data: Any = None,
        envelope: Envelope = NO_ENVELOPE,
    ) -> None:
        """Begin the line of an event from outside; the previous line is complete.

        Raises LoopError if this repeats too often at one point in time.
        """
        self.flush()
        life = self.lives[instance]
        life.arrives()
        if self.is_heard:
            self._line = Line(self._clock.now, life.actor, event, data=data, envelope=envelope)
        elif self.spread is not None:
            assert isinstance(life, ReportingLife)
            self.reporting = life
            life.arrived, life.begun = None, (event, data, envelope)

    @property
    def actor(self) -> Actor:
        """Actor that processed the last event."""
        assert self.statistics.active is not None
        return self.statistics.active.actor

    def flush(self) -> None:
        """Pass the completed line to the listeners, if there is one."""
        reporter = self.reporting
        if reporter is not None:
            self.reporting = None
            reporter.end()
        line, self._line = self._line, None
        if line is None:
            return
        assert self.statistics.active is not None
        instance = self.statistics.active.instance
        # An ended machine has no active states: report its final state instead.
        line.configuration = (
            [instance.final] if instance.final else instance.configuration.innermost
        )
        line.at = self._place(line.actor.robot)
        for listener in self._listeners:
            listener(line)

    # ---- called by the instance

    def received(self, instance: InstanceLike, event: Event) -> None:
        """Begin a line for a delay or an activity; other events have one already."""
        if event.origin is not None:
            self.begin(instance, event.name, event.data)

    def ignored(self, instance: InstanceLike, event: Event) -> None:
        """Record it."""
        self.lives[instance].ignored(instance, event)
        assert self._line is not None
        self._line.ignored = True

    def deferred(self, instance: InstanceLike, event: Event) -> None:
        """Record it."""
        assert self._line is not None
        self._line.deferred = True

    def dropped(self, instance: InstanceLike, event: Event) -> None:
        """Record it."""
        self.lives[instance].dropped(instance, event)
        assert self._line is not None
        self._line.dropped.append(event.name)

    def recalled(self, instance: InstanceLike, event: Event) -> None:
        """Begin a line for the event."""
        self.begin(instance, event.name, event.data, event.envelope)
        assert self._line is not None
        self._line.recalled = True

    def scheduled(self, instance: InstanceLike, event: Event, delay: int) -> None:
        """Record it."""
        assert self._line is not None
        self._line.scheduled.append((event.name, event.envelope.to, delay))

    def withdrawn(self, instance: InstanceLike, event: Event) -> None:
        """Record it."""
        assert self._line is not None
        self._line.withdrawn.append(event.name)

    def entered(self, instance: InstanceLike, state: State) -> None:
        """Record it."""
        self.lives[instance].entered(instance, state)
        assert self._line is not None
        self._line.entered.append(state.id)

    def exited(self, instance: InstanceLike, state: State) -> None:
        """Record it, except for the final state of the machine."""
        self.lives[instance].exited(instance, state)
        assert self._line is not None
        if instance.final is None:
            self._line.exited.append(state.id)

    def taken(self, instance: InstanceLike, transition: Transition) -> None:
        """Record it."""
        self.lives[instance].taken(instance, transition)
        assert self._line is not None
        self._line.taken.append(transition)

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Record it."""
        self.lives[instance].started(instance, run)
        assert self._line is not None
        self._line.started.append(run.activity.name)

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """Record it."""
        assert self._line is not None
        self._line.cancelled.append(run.activity.name)

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Record it."""
        self.lives[instance].sent(instance, event)
        assert self._line is not None
        self._line.sent.append(event.name)
        self._line.messages.append(event.data)
        self._line.addresses.append(event.envelope.to)

    def reaches_nobody(self) -> None:
        """Record that no other robot has the address of the last sent event."""
        if self.reporting is not None:
            self.reporting.reaches_nobody()
        if self._line is not None:
            self._line.nobody.append(len(self._line.sent) - 1)


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


EMPTY = '""'
"""Address of nobody: an empty string."""
