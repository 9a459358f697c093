"""Course of a run under control: where it stops, how it goes on, and how it goes back.

A run is deterministic. To go back is to play it again to an earlier point, with what the user
has done until then.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import Event, Instance, InstanceLike, State, Transition
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.runner import Pace
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.ide.debugger.breakpoints import Breakpoints
from swarmdsl.ide.debugger.client import Client, RunAgainError
from swarmdsl.ide.debugger.expressions import Expressions, Result
from swarmdsl.ide.debugger.points import Element, Kind, Microsteps, Point, Way
from swarmdsl.ide.debugger.values import text_of

VIOLATIONS, FAILURES = "violations", "failures"
"""Filters of exceptions: violated properties, and expressions that fail."""
GO_ON = Way("breakpoint")
_NAP = 0.05
"""Greatest time for which a run in real time does not listen to the user, in seconds."""


@dataclass(frozen=True)
class Deed:
    """Act of the user: an event that is sent, or the value that a variable of a member gets."""

    event: Mapping[str, Any] | None = None
    member: int = 0
    variable: str = ""
    value: Any = None


class _Watching(Microsteps):
    """Observer that reports microsteps to the controls."""

    def __init__(self, controls: Controls, world: World) -> None:
        super().__init__(world.trace)
        self._controls = controls

    def reached(self, instance: InstanceLike, element: Element) -> None:
        """Let the run stop."""
        if isinstance(element, Transition) or element.id:
            actor = self._controls.world.trace.lives[instance].actor
            self._controls.arrive("microstep", self._controls.members[actor], element)


class Controls:
    """Stage of one run at a time; points count from 1."""

    def __init__(
        self,
        subject: Subject,
        client: Client,
        breakpoints: Breakpoints,
        expressions: Expressions,
        speed: float | None,
    ) -> None:
        self.pace: Pace = _Waiting(self)
        self.speed = speed
        """Number of times that virtual time is as fast as real time; None for any speed."""
        self.subject = subject
        self.way: Way = GO_ON
        self.breakpoints = breakpoints
        self.filters: frozenset[str] = frozenset((VIOLATIONS, FAILURES))
        self.deeds: dict[int, list[Deed]] = {}
        """Acts of the user, by the points at which the run stood still."""
        self.perform: Callable[[Deed], None] = lambda deed: None
        self.finds = False
        """True while the last breakpoint before a point is looked for."""
        self.wants_pause = False
        self.stops = True
        """False if the run goes to its end without the user."""
        self._client = client
        self._expressions = expressions
        self.reset()

    def reset(self) -> None:
        """Forget the run before: the next one begins."""
        self.cast: Sequence[Actor] = ()
        self.members: dict[Actor, int] = {}
        """Numbers of the machines in the cast."""
        self.number = 0
        self.point = Point("between", 0)
        self.step: Span | None = None
        """Place of the step of a test that drives the run."""
        self.last: dict[int, Line] = {}
        """Last line of each member."""
        self.moments: list[int] = []
        self.hit: list[int] = []
        """Numbers of the ends of macrosteps, and of points with breakpoints, so far."""
        self.watching: _Watching | None = None
        self._world: World | None = None
        self.has_failed = False
        """True if the run could not go on, or is a test that fails."""
        self._faults: list[str] = []
        self._known_failures: Counter[tuple[str, str]] = Counter()
        self.breakpoints.begin()

    @property
    def world(self) -> World:
        """The world that runs."""
        assert self._world is not None
        return self._world

    @property
    def has_begun(self) -> bool:
        """True once there are robots."""
        return self._world is not None

    @property
    def is_replaying(self) -> bool:
        """True while the run is played again, unseen."""
        return self.way.to == "point"

    @property
    def instances(self) -> dict[Actor, Instance]:
        """The running machines."""
        return {life.actor: life.instance for life in self.world.trace.lives.values()}

    def event(self, member: int) -> Event | None:
        """Return the event that a member has processed last."""
        assert self.watching is not None
        return self.watching.events.get(self.instances[self.cast[member]])

    def evaluate(self, text: str, member: int, state: str | None = None) -> Result:
        """Return the value of an expression for a member, in a state if one is given."""
        actor = self.cast[member]
        instance = self.instances[actor]
        event = self.event(member)
        if state is None:
            state = self._state(member, instance)
        return self._expressions.value(text, actor, instance, event, state)

    def _state(self, member: int, instance: Instance) -> str:
        """Return the state in which expressions of a member are meant."""
        element = self.point.element if self.point.member == member else None
        if isinstance(element, State):
            return element.id
        if element is not None:
            return instance.machine.called(element).rpartition("->")[0]
        return next(iter(instance.configuration.innermost), "")

    # ---- called by the program

    def begin(self, cast: Sequence[Actor], world: World) -> None:
        """Note who runs, before the world begins."""
        self.cast, self._world = list(cast), world
        self.members = {actor: number for number, actor in enumerate(cast)}
        self.watching = world.trace.observer = _Watching(self, world)

    def see(self, line: Line) -> None:
        """Show the end of a macrostep, and let the run stop."""
        member = self.members[line.actor]
        self.last[member] = line
        if not self.is_replaying:
            self._client.moved(line)
        self.arrive("moment", member, line=line)

    def rest(self) -> bool:
        """Let the run stop where nothing is left to happen; return True to end then."""
        self.arrive("idle", self.point.member)
        return self.way == GO_ON

    def violated(self, name: str) -> None:
        """Note a violation: the run stops at the end of the step."""
        if VIOLATIONS in self.filters:
            self._faults.append(f"property `{name}` is violated")

    def fail(self, why: str) -> None:
        """Let the run stop where it cannot go on."""
        self.has_failed = True
        self._faults.append(why)
        self.arrive("failed", self.point.member)

    def reach(self, step: Span) -> None:
        """Note the step of a test."""
        self.step = step

    def judged(self, result: Mapping[str, Any]) -> None:
        """Show the result of a test."""
        self.has_failed = result["outcome"] != "passed"
        self._client.judged(result)

    def tell(self, text: str) -> None:
        """Show a line to the user."""
        self._client.tell(text, "console")

    def poll(self) -> None:
        """Let the user act while nothing is on the stage."""
        self._client.poll()

    # ---- points

    def arrive(
        self, kind: Kind, member: int, element: Element | None = None, line: Line | None = None
    ) -> None:
        """Reach a point, and stand still there if there is a reason."""
        self.number += 1
        self.point = Point(kind, member, element, line)
        if kind in ("moment", "idle"):
            self.moments.append(self.number)
        if not self.stops:
            if kind != "microstep":
                self._client.poll()
            return
        is_hit = element is not None and self._is_hit(element, member)
        if is_hit:
            self.hit.append(self.number)
        if self._goes_back(kind):
            return
        reason, text = self._reason(is_hit)
        if reason:
            self.hold(reason, text)
        elif kind in ("moment", "between"):
            self.look()

    def look(self) -> None:
        """Let the user act while the run goes on."""
        self._client.poll()
        if self.wants_pause:
            self.hold("pause")

    def hold(self, reason: str, text: str = "") -> None:
        """Stand still until the user goes on."""
        self.wants_pause = False
        self.way = GO_ON
        self._client.hold(reason, text)

    def act(self, deed: Deed) -> None:
        """Do what the user wants, at this point of this run and of those that repeat it."""
        self.perform(deed)
        self.deeds.setdefault(self.number, []).append(deed)

    def _goes_back(self, kind: Kind) -> bool:
        """Return True on the way to an earlier point; stand still there."""
        if not self.is_replaying:
            return False
        self._faults.clear()
        self._known_failures = Counter(self.world.failures)
        if self.number < self.way.point and kind != "failed":
            for deed in self.deeds.get(self.number, ()):
                self.perform(deed)
            return True
        if self.finds:
            self.finds = False
            before = [each for each in self.hit if each < self.way.point]
            raise RunAgainError(before[-1] if before else 1)
        for number in [each for each in self.deeds if each >= self.number]:
            del self.deeds[number]
        self.hold("step", self._described())
        return True

    def _reason(self, is_hit: bool) -> tuple[str, str]:
        """Return why the run stops here, and a text; empty if it does not."""
        failures = self.world.failures
        if failures.total() > self._known_failures.total():
            new = failures - self._known_failures
            self._known_failures = Counter(failures)
            if FAILURES in self.filters:
                self._faults += [f"an expression failed: {reason}" for _, reason in new]
        if self._faults:
            text = "; ".join(self._faults)
            self._faults.clear()
            return "exception", text
        if is_hit:
            return "breakpoint", self._described()
        if self.point.kind == "idle":
            return "pause", "nothing is left to happen: send an event, or continue to the end"
        if self.way.ends(self.point, self.world.clock.now):
            return "step", self._described()
        return "", ""

    def _described(self) -> str:
        who = self.cast[self.point.member].name if self.cast else None
        when = format_duration(self.world.clock.now)
        return f"{who}, at {when}" if who else f"at {when}"

    def _is_hit(self, element: Element, member: int) -> bool:
        """Return True at a breakpoint that counts; tell the messages of others."""
        stops = False
        for each in self.breakpoints.at(element):
            if not each.hits(member, self.evaluate):
                continue
            stops |= not each.message
            if each.message and not self.is_replaying:
                self.tell(each.told(member, self.evaluate, text_of))
        return stops


class _Waiting(Pace):
    """Pace of a run that lets the user act between the moments.

    With a speed, time passes at that while the run goes on by itself: a step does not wait.
    """

    def __init__(self, controls: Controls) -> None:
        super().__init__()
        self._controls = controls

    def wait(self, until: int) -> None:
        """Let the user act, and wait until a time if there is a speed."""
        controls = self._controls
        controls.arrive("between", controls.point.member)
        left = (until - controls.world.clock.now) / SECOND
        while left > 0 and controls.speed is not None and controls.way == GO_ON:
            time.sleep(min(left / controls.speed, _NAP))
            left -= _NAP * controls.speed
            controls.look()
