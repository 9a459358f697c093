"""Points of a run at which it can stop, and how it goes on from one."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.execution.engine import Event, InstanceLike, Observer, Run, State, Transition
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.trace import Trace

Kind = Literal["microstep", "moment", "between", "idle", "failed"]
Element = State | Transition


@dataclass(frozen=True)
class Point:
    """Point of a run.

    In a `microstep`, `element` is the state that the machine enters or the transition that it
    takes. A `moment` is the end of a macrostep, with its line of the trace. A point is `between`
    two of these where time may pass, and `idle` where nothing is left to happen.
    """

    kind: Kind
    member: int
    """Number of the machine in the cast."""
    element: Element | None = None
    line: Line | None = None


@dataclass(frozen=True)
class Way:
    """Way to go on: to a breakpoint, or to the end of one of these.

    A `microstep` or a `transition` is that of a member, a `moment` that of any. An `event` is the
    next one of that name, unless time passes before. `point` is the number of a point, for a run
    that is played again.
    """

    to: Literal["breakpoint", "microstep", "transition", "moment", "event", "point"]
    member: int = 0
    event: str = ""
    time: int = 0
    point: int = 0

    def ends(self, point: Point, now: int) -> bool:
        """Return True if the run stops at a point."""
        match self.to:
            case "microstep":
                return point.member == self.member and point.kind in ("microstep", "moment")
            case "transition":
                line = point.line
                moved = line is not None and bool(line.taken or line.entered or line.exited)
                return point.member == self.member and moved
            case "moment":
                return point.kind == "moment"
            case "event":
                line = point.line
                return now > self.time or (line is not None and line.event == self.event)
        return False


class Microsteps(Observer):
    """Observer of instances that passes everything on to the trace of a run, and tells microsteps.

    `events` has the event that each instance has processed last.
    """

    def __init__(self, trace: Trace) -> None:
        self._trace = trace
        self.events: dict[InstanceLike, Event] = {}

    def reached(self, instance: InstanceLike, element: Element) -> None:
        """Handle a state that is entered, or a transition that is taken."""

    def received(self, instance: InstanceLike, event: Event) -> None:
        """Pass it on, and note the event."""
        self.events[instance] = event
        self._trace.received(instance, event)

    def ignored(self, instance: InstanceLike, event: Event) -> None:
        """Pass it on."""
        self._trace.ignored(instance, event)

    def deferred(self, instance: InstanceLike, event: Event) -> None:
        """Pass it on."""
        self._trace.deferred(instance, event)

    def dropped(self, instance: InstanceLike, event: Event) -> None:
        """Pass it on."""
        self._trace.dropped(instance, event)

    def recalled(self, instance: InstanceLike, event: Event) -> None:
        """Pass it on."""
        self._trace.recalled(instance, event)

    def exited(self, instance: InstanceLike, state: State) -> None:
        """Pass it on."""
        self._trace.exited(instance, state)

    def taken(self, instance: InstanceLike, transition: Transition) -> None:
        """Pass it on, and tell the microstep."""
        self._trace.taken(instance, transition)
        self.reached(instance, transition)

    def entered(self, instance: InstanceLike, state: State) -> None:
        """Pass it on, and tell the microstep."""
        self._trace.entered(instance, state)
        self.reached(instance, state)

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Pass it on."""
        self._trace.started(instance, run)

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """Pass it on."""
        self._trace.cancelled(instance, run)

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Pass it on."""
        self._trace.sent(instance, event)

    def scheduled(self, instance: InstanceLike, event: Event, delay: int) -> None:
        """Pass it on."""
        self._trace.scheduled(instance, event, delay)

    def withdrawn(self, instance: InstanceLike, event: Event) -> None:
        """Pass it on."""
        self._trace.withdrawn(instance, event)

    def logged(self, instance: InstanceLike, text: str) -> None:
        """Pass it on."""
        self._trace.logged(instance, text)
