"""Lines for the monitors of properties alone, of what can change a fact."""

from __future__ import annotations

from collections.abc import Container, Iterable
from functools import partial
from typing import Any, cast

from swarmdsl.execution.engine import (
    NO_ENVELOPE,
    Configuration,
    Envelope,
    Event,
    InstanceLike,
    Run,
    State,
)
from swarmdsl.execution.monitor import Watch
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.statistics import Life
from swarmdsl.execution.simulate.world.trace import Audience, ReportingLife, Trace


def observe(trace: Trace, watch: Watch, clock: Clock) -> None:
    """Let reporters observe all instances, for monitors that are the only listener of a run."""
    for instance, life in trace.lives.items():
        trace.lives[instance] = Reporter(life, watch, clock, trace)
    trace.spread = partial(spread, trace, watch)
    watch.open = Note


def spread(
    trace: Trace, watch: Watch, event: Event, sender: Robot, audience: Iterable[Audience]
) -> None:
    """Let the instances of other robots process an event, which may be one of millions."""
    name = event.name
    for robot, lives in audience:
        if robot is sender:
            continue
        for life in cast("list[Reporter]", lives):
            instance = life.instance
            if instance.running:
                life.arrives()
                life.arrived = event
                trace.reporting = life
                instance.receive(event)
                # If none of this is so, it ends when the next one begins.
                if life.noted or watch.happened or name in life.wakes:
                    trace.flush()


Record = tuple[int, Actor, "str | None", object, Envelope, "list[Noted]", "Place"]
"""Parts of a note."""
Place = str | Configuration
"""Configuration of an instance or, at its end, its final state."""
Noted = State | Run | tuple[str, object]
"""State that was entered, run that was started, or the name of a field of a line with its value."""
IGNORED, DEFERRED, RECALLED = (("ignored", True), ("deferred", True), ("recalled", True))


class _Everything:
    """Container of all names."""

    def __contains__(self, name: object) -> bool:
        return True


EVERYTHING = _Everything()


class Note:
    """Line of a trace, without exited states, that is made when somebody asks for more of it.

    `noted` is what the instance has done.
    """

    __slots__ = (
        "_line",
        "_place",
        "actor",
        "data",
        "envelope",
        "event",
        "noted",
        "time",
    )

    def __init__(self, record: Record) -> None:
        self.time, self.actor, self.event, self.data, self.envelope = record[:5]
        self.noted, self._place = record[5:]
        self._line: Line | None = None

    @property
    def deferred(self) -> bool:
        """True if the event is kept for later."""
        return DEFERRED in self.noted

    @property
    def recalled(self) -> bool:
        """True if the event has been kept before."""
        return RECALLED in self.noted

    def __getattr__(self, field: str) -> Any:
        """Return another field of the line."""
        if self._line is None:
            line = Line(self.time, self.actor, self.event, envelope=self.envelope)
            line.configuration = innermost(self._place)
            line.data = self.data
            for each in self.noted:
                if isinstance(each, State):
                    line.entered.append(each.id)
                elif isinstance(each, Run):
                    line.started.append(each.activity.name)
                elif each in (IGNORED, DEFERRED, RECALLED):
                    setattr(line, each[0], True)
                else:
                    getattr(line, each[0]).append(each[1])
            self._line = line
        return getattr(self._line, field)


def innermost(place: Place) -> list[str]:
    """Return the innermost states of a configuration, or the final state."""
    return [place] if isinstance(place, str) else place.innermost


class Reporter(ReportingLife):
    """Statistics of an instance that note what it does, and pass on what matters to monitors.

    `noted` is what it has done since its last event arrived.
    """

    __slots__ = (
        "_cancels",
        "_conditional",
        "_from_outside",
        "_from_robots",
        "_happening",
        "_is_odd",
        "_kind",
        "_places",
        "_sends",
        "_starts",
        "_trace",
        "_values",
        "_watch",
        "noted",
        "wakes",
    )

    def __init__(self, life: Life, watch: Watch, clock: Clock, trace: Trace) -> None:
        super().__init__(life.instance, life.actor, clock, trace.statistics)
        self._watch, self._trace = watch, trace
        kind = self._kind = watch.plan.kind(life.actor)
        self._places = kind.places
        self._starts, self._cancels = kind.acts["starts"], kind.acts["cancels"]
        self._sends = kind.acts["sends"]
        self._happening = 0
        self._from_outside, self._from_robots = kind.from_outside, kind.from_robots
        self.wakes: Container[str] = EVERYTHING if kind.values else kind.acts["hears"]
        """Events that can change a fact, even if the instance does nothing."""
        self._is_odd = False
        """True if the event is kept, or has been."""
        self._values = kind.values
        self._conditional = kind.conditional
        self.arrived, self.begun = None, (None, None, NO_ENVELOPE)
        self.noted: list[Noted] = []

    def end(self) -> None:
        """End the macrostep: pass it to the monitors."""
        instance, noted, arrived = self.instance, self.noted, self.arrived
        if arrived is None:
            event, data, envelope = self.begun
        else:
            event, data, envelope = arrived.name, arrived.data, arrived.envelope
        place = instance.final or instance.configuration
        facts = self._places.get(place)
        if facts is None:
            facts = self._places[place] = self._kind.inside(innermost(place))
        if self._is_odd:
            facts |= self._arriving(event, envelope)
        elif envelope.sender:
            facts |= self._from_robots.get(event, self._values)
        else:
            facts |= self._from_outside.get(event, self._values)
        facts |= self._happening
        now = self._clock.now
        record = (now, self.actor, event, data, envelope, noted, place)
        if facts & self._conditional:
            facts = self._kind.under_conditions(Note(record), self._watch.has, facts)
        self.noted, self._happening = [], 0
        self._watch.take(now, self.actor, event, facts, record)

    def _arriving(self, event: str | None, envelope: Envelope) -> int:
        """Return the facts about an event that is kept, or has been."""
        self._is_odd, noted = False, self.noted
        sender = envelope.sender
        return self._kind.arriving(event, sender, DEFERRED in noted, RECALLED in noted)

    # ---- called by the instance

    def received(self, instance: InstanceLike, event: Event) -> None:
        """Begin with a delay or an activity; the world tells other events."""
        if event.origin is not None:
            trace = self._trace
            if trace.reporting is not None:
                trace.flush()
            self.arrives()
            self.arrived = event
            trace.reporting = self

    def ignored(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        Life.ignored(self, instance, event)
        self.noted.append(IGNORED)

    def deferred(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self.noted.append(DEFERRED)
        self._is_odd = True

    def dropped(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        Life.dropped(self, instance, event)
        self.noted.append(("dropped", event.name))

    def recalled(self, instance: InstanceLike, event: Event) -> None:
        """Begin with the event."""
        self._trace.begin(instance, event.name, event.data, event.envelope)
        self.noted.append(RECALLED)
        self._is_odd = True

    def scheduled(self, instance: InstanceLike, event: Event, delay: int) -> None:
        """Note it."""
        self.noted.append(("scheduled", (event.name, event.envelope.to, delay)))

    def withdrawn(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self.noted.append(("withdrawn", event.name))

    def entered(self, instance: InstanceLike, state: State) -> None:
        """Note it."""
        # As in `Life`, without a call for each of what may be millions.
        self.since = self._entries[state.id] = self._clock.now
        self._counted.entered[state.id] += 1
        self.noted.append(state)

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        self._whole.called[run.activity.name] += 1
        self.noted.append(run)
        if self._starts:
            self._happening |= self._starts.get(run.activity.name, 0)

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        name = run.activity.name
        self.noted.append(("cancelled", name))
        self._happening |= self._cancels.get(name, 0)

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        Life.sent(self, instance, event)
        self.noted += (("sent", event.name), ("addresses", event.envelope.to))
        self.noted.append(("messages", event.data))
        self._happening |= self._sends.get(event.name, 0)

    def reaches_nobody(self) -> None:
        """Note that no other robot has the address of the last sent event."""
        sent = [each for each in self.noted if type(each) is tuple and each[0] == "sent"]
        self.noted.append(("nobody", len(sent) - 1))
