"""Trace of a run, one line per macrostep."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

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
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.scenario.space import Place
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.statistics import Life, Statistics

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
