"""Lines for the monitors of properties alone, of what can change a fact."""

from __future__ import annotations

from collections.abc import Container

from swarmdsl.execution.engine import NO_ENVELOPE, Envelope, Event, InstanceLike, Run, State
from swarmdsl.execution.monitor import LOST, Interest, Watch
from swarmdsl.execution.simulate.clock import Clock
from swarmdsl.execution.simulate.statistics import Life
from swarmdsl.execution.simulate.trace import Line, ReportingObserver, Trace


def observe(trace: Trace, watch: Watch, clock: Clock) -> None:
    """Let reporters observe all instances, for monitors that are the only listener of a run."""
    interests: dict[tuple[object, ...], Interest] = {}
    for instance, life in trace.lives.items():
        actor = life.actor
        alike = (actor.robot.role, actor.machine, actor.name == actor.robot.name)
        if alike not in interests:
            interests[alike] = watch.interest(actor)
        trace.reporters[instance] = Reporter(life, interests[alike], watch, clock, trace)


class _Everything(Container["str | None"]):
    """Events by which values can change: all of them."""

    def __contains__(self, _event: object) -> bool:
        """Return True."""
        return True


class Reporter(ReportingObserver):
    """Observer of an instance that notes what it does, and makes a line only where it matters.

    The statistics of the instance see all of it. `noted` is what it has done since its last event
    arrived, as fields of a line with their values.
    """

    __slots__ = (
        "_acts",
        "_clock",
        "_inside",
        "_life",
        "_states",
        "_trace",
        "_was_inside",
        "_watch",
        "data",
        "envelope",
        "event",
        "heard",
        "messages",
        "noted",
        "taken",
    )

    def __init__(
        self, life: Life, interest: Interest, watch: Watch, clock: Clock, trace: Trace
    ) -> None:
        self._life, self._watch, self._clock, self._trace = life, watch, clock, trace
        self._acts = interest.acts
        self._states = {state: 1 << bit for bit, state in enumerate(sorted(interest.states))}
        self._inside = self._was_inside = 0
        # A robot that comes or is lost always matters.
        heard = interest.heard | {None, LOST}
        self.heard: Container[str | None] = _Everything() if interest.values else heard
        self.event: str | None = None
        self.data: object = None
        self.envelope = NO_ENVELOPE
        self.noted: list[tuple[str, object]] = []
        self.messages: list[object] = []
        """Messages of the events in `noted` that were sent."""
        # Millions of transitions need no call more than that of the statistics.
        self.taken = life.taken  # type: ignore[method-assign]

    def receive(self, event: Event) -> None:
        """Let the instance process an event from others, which may be one of millions."""
        life, name = self._life, event.name
        life.arrives()
        self.event, self.data, self.envelope = name, event.data, event.envelope
        self._trace.reporting = self
        life.instance.receive(event)
        # If none of this is so, it ends when the next one begins.
        if self.noted or name in self.heard or self._watch.happened:
            self._trace.flush()

    def begin(self, event: str | None, data: object, envelope: Envelope) -> None:
        """Begin with an event from outside, or with the start of the instance."""
        self.event, self.data, self.envelope = event, data, envelope
        if event is None:
            self._inside = 0  # a robot that was lost has left no state

    def end(self) -> None:
        """End the macrostep: pass a line to the monitors if it can change a fact."""
        watch, noted = self._watch, self.noted
        if (
            self._inside != self._was_inside
            or self.event in self.heard
            or watch.happened
            or (self._acts and not self._acts.isdisjoint(noted))
        ):
            self._was_inside = self._inside
            watch.see(self._line())
        elif watch.late_after is not None and self._clock.now > watch.late_after:
            watch.advance(self._clock.now)
        noted.clear()
        self.messages.clear()

    def _line(self) -> Line:
        instance = self._life.instance
        line = Line(
            self._clock.now,
            self._life.actor,
            self.event,
            data=self.data,
            messages=[*self.messages],
            envelope=self.envelope,
        )
        line.configuration = (
            [instance.final] if instance.final else instance.configuration.innermost
        )
        for field, value in self.noted:
            if value is True:
                setattr(line, field, value)
            else:
                getattr(line, field).append(value)
        return line

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
        if state.id in self._states:
            self._inside |= self._states[state.id]

    def exited(self, instance: InstanceLike, state: State) -> None:
        """Note it, except for the final state of the machine."""
        self._life.exited(instance, state)
        if instance.final is None:
            self.noted.append(("exited", state.id))
            if state.id in self._states:
                self._inside &= ~self._states[state.id]

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        self._life.started(instance, run)
        self.noted.append(("started", run.activity.name))

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """Note it."""
        self.noted.append(("cancelled", run.activity.name))

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Note it."""
        self._life.sent(instance, event)
        self.noted += (("sent", event.name), ("addresses", event.envelope.to))
        self.messages.append(event.data)

    def reaches_nobody(self) -> None:
        """Note that no other robot has the address of the last sent event."""
        number = sum(field == "sent" for field, _ in self.noted) - 1
        self.noted.append(("nobody", number))
