"""Lines for the monitors of properties alone, of what can change a fact."""

from __future__ import annotations

from typing import Any

from swarmdsl.execution.engine import (
    NO_ENVELOPE,
    Configuration,
    Envelope,
    Event,
    InstanceLike,
    Run,
    State,
)
from swarmdsl.execution.monitor import Kind, Watch
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.clock import Clock
from swarmdsl.execution.simulate.statistics import Life
from swarmdsl.execution.simulate.trace import Line, ReportingObserver, Trace


def observe(trace: Trace, watch: Watch, clock: Clock) -> None:
    """Let reporters observe all instances, for monitors that are the only listener of a run."""
    for instance, life in trace.lives.items():
        kind = watch.plan.kind(life.actor)
        trace.reporters[instance] = Reporter(life, kind, watch, clock, trace)


class Note:
    """Line of a trace, without exited states, that is made when somebody asks for more of it.

    `noted` is what the instance has done, as fields of a line with their values; `place` is its
    configuration or, at its end, its final state.
    """

    __slots__ = (
        "_line",
        "actor",
        "data",
        "envelope",
        "event",
        "messages",
        "noted",
        "place",
        "time",
    )

    def __init__(
        self,
        time: int,
        actor: Actor,
        event: str | None,
        data: object,
        envelope: Envelope,
        messages: list[object],
        noted: list[tuple[str, object]],
        place: str | Configuration,
    ) -> None:
        self.time = time
        self.actor = actor
        self.event = event
        self.data = data
        self.envelope = envelope
        self.messages = messages
        self.noted = noted
        self.place = place
        self._line: Line | None = None

    @property
    def deferred(self) -> bool:
        """True if the event is kept for later."""
        return ("deferred", True) in self.noted

    @property
    def recalled(self) -> bool:
        """True if the event has been kept before."""
        return ("recalled", True) in self.noted

    def __getattr__(self, field: str) -> Any:
        """Return another field of the line."""
        if self._line is None:
            line = Line(self.time, self.actor, self.event, envelope=self.envelope)
            line.configuration = innermost(self.place)
            line.data, line.messages = self.data, self.messages
            for name, value in self.noted:
                if value is True:
                    setattr(line, name, value)
                else:
                    getattr(line, name).append(value)
            self._line = line
        return getattr(self._line, field)


def innermost(place: str | Configuration) -> list[str]:
    """Return the innermost states of a configuration, or the final state."""
    return [place] if isinstance(place, str) else place.innermost


class Reporter(ReportingObserver):
    """Observer of an instance that notes what it does, and makes a line only where it matters.

    The statistics of the instance see all of it. `noted` is what it has done since its last event
    arrived, as fields of a line with their values.
    """

    __slots__ = (
        "_cancels",
        "_clock",
        "_happening",
        "_holding",
        "_kind",
        "_life",
        "_places",
        "_sends",
        "_starts",
        "_trace",
        "_values",
        "_watch",
        "data",
        "envelope",
        "event",
        "exited",
        "heard",
        "messages",
        "noted",
        "taken",
    )

    def __init__(self, life: Life, kind: Kind, watch: Watch, clock: Clock, trace: Trace) -> None:
        self._life, self._watch, self._clock, self._trace = life, watch, clock, trace
        self._kind = kind
        self._places = kind.places
        self._starts, self._cancels = kind.acts["starts"], kind.acts["cancels"]
        self._sends = kind.acts["sends"]
        self._holding = self._happening = 0
        self.heard = kind.heard
        self._values = kind.values
        self.event: str | None = None
        self.data: object = None
        self.envelope = NO_ENVELOPE
        self.noted: list[tuple[str, object]] = []
        self.messages: list[object] = []
        """Messages of the events in `noted` that were sent."""
        # Nobody asks for these: they need no call more than that of the statistics.
        self.taken = life.taken  # type: ignore[method-assign]
        self.exited = life.exited  # type: ignore[method-assign]

    def receive(self, event: Event) -> None:
        """Let the instance process an event from others, which may be one of millions."""
        life, name = self._life, event.name
        life.arrives()
        self.event, self.data, self.envelope = name, event.data, event.envelope
        self._trace.reporting = self
        life.instance.receive(event)
        # If none of this is so, it ends when the next one begins.
        if self.noted or name in self.heard or self._values or self._watch.happened:
            self._trace.flush()

    def begin(self, event: str | None, data: object, envelope: Envelope) -> None:
        """Begin with an event from outside, or with the start of the instance."""
        self.event, self.data, self.envelope = event, data, envelope

    def end(self) -> None:
        """End the macrostep: pass a line to the monitors if it can change a fact."""
        watch, instance, happening = self._watch, self._life.instance, self._happening
        place = instance.final or instance.configuration
        holding = self._places.get(place)
        if holding is None:
            holding = self._places[place] = self._kind.inside(innermost(place))
        heard = self.heard.get(self.event, self._values)
        different = holding ^ self._holding | happening | heard
        self._holding = holding
        if different & watch.wanted or watch.happened:
            note = Note(
                self._clock.now,
                self._life.actor,
                self.event,
                self.data,
                self.envelope,
                self.messages,
                self.noted,
                place,
            )
            self.noted, self.messages, self._happening = [], [], 0
            holding |= happening
            if heard or happening & self._kind.conditional:
                holding = self._kind.complete(note, watch.has, holding)
            watch.see(note, holding)
            return
        self._happening = 0
        if watch.late_after is not None and self._clock.now > watch.late_after:
            watch.advance(self._clock.now)
        self.noted.clear()
        self.messages.clear()

    # ---- called by the instance

    def received(self, instance: InstanceLike, event: Event) -> None:
        """Begin with a delay or an activity; the world tells other events."""
        if event.origin is not None:
            trace = self._trace
            if trace.reporting is not None:
                trace.flush()
            self._life.arrives()
            self.event, self.data, self.envelope = event.name, event.data, NO_ENVELOPE
            trace.reporting = self

    def ignored(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self._life.ignored(instance, event)
        self.noted.append(("ignored", True))

    def deferred(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self.noted.append(("deferred", True))

    def dropped(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self._life.dropped(instance, event)
        self.noted.append(("dropped", event.name))

    def recalled(self, instance: InstanceLike, event: Event) -> None:
        """Begin with the event."""
        self._trace.begin(instance, event.name, event.data, event.envelope)
        self.noted.append(("recalled", True))

    def scheduled(self, instance: InstanceLike, event: Event, delay: int) -> None:
        """Note it."""
        self.noted.append(("scheduled", (event.name, event.envelope.to, delay)))

    def withdrawn(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self.noted.append(("withdrawn", event.name))

    def entered(self, instance: InstanceLike, state: State) -> None:
        """Note it."""
        self._life.entered(instance, state)
        self.noted.append(("entered", state.id))

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        self._life.started(instance, run)
        name = run.activity.name
        self.noted.append(("started", name))
        self._happening |= self._starts.get(name, 0)

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        name = run.activity.name
        self.noted.append(("cancelled", name))
        self._happening |= self._cancels.get(name, 0)

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self._life.sent(instance, event)
        self.noted += (("sent", event.name), ("addresses", event.envelope.to))
        self.messages.append(event.data)
        self._happening |= self._sends.get(event.name, 0)

    def reaches_nobody(self) -> None:
        """Note that no other robot has the address of the last sent event."""
        number = sum(field == "sent" for field, _ in self.noted) - 1
        self.noted.append(("nobody", number))
