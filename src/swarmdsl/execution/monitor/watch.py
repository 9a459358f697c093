"""Properties and measures of one run, from the lines of its trace to verdicts and values."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple, TypeVar

from .claims import Measure, Property
from .facts import ACTS, ActorLike, FactTracker, Has, LineLike, Route, meant_states
from .meters import Gauge, Reading
from .monitor import FALSE, OPEN, TRUE, Monitor, Verdict
from .truth import Claims, Trackers, is_momentary

REMEMBERED = 8
"""Number of trace lines kept with a violation, of those that changed a fact."""
START = 5_000_000_000
"""Time in nanoseconds in which machines start at one moment if nothing else happens."""


class Violation(NamedTuple):
    """Violation of a property, by a robot if it is about each one, with the last trace lines."""

    property: Property
    robot: str | None
    time: int
    last: tuple[Any, ...]


class PropertyResult(NamedTuple):
    """Verdict on a property at the end of a run; `robots` are those with the same verdict.

    `remark` says why a true one says nothing of the run.
    """

    property: Property
    verdict: Verdict
    robots: tuple[str, ...]
    violations: tuple[Violation, ...]
    remark: str = ""


class Interest(NamedTuple):
    """Parts of the lines of a machine that can change a fact.

    Events that it hears, states by their paths, and what it does: a field of a line with a name.
    With `values`, every line can.
    """

    heard: frozenset[str]
    states: frozenset[str]
    acts: frozenset[tuple[str, str]]
    values: bool


class ViolatedError(Exception):
    """A property is violated, and the run must stop then."""


class Watch:
    """Monitors of properties and gauges of measures in one run, a listener of its trace.

    Lines come in the order of time; those without `interest` can be left out, except for the first
    one of a machine, its loss, and the next one of all after something `happened`. `has` evaluates
    conditions; `told` is called with a property, its verdict so far, and the time from which on it
    holds. With `stops`, a violation raises ViolatedError, unless the property has a chance.
    """

    def __init__(
        self,
        properties: Iterable[Property],
        has: Has,
        *,
        measures: Iterable[Measure] = (),
        stops: bool = False,
        told: Callable[[Property, Verdict, int], None] | None = None,
    ) -> None:
        self.violations: list[Violation] = []
        self._trackers = Trackers(has)
        self._stops = stops
        self._told = told
        self._watched = [_Watched(each, self._trackers) for each in properties]
        self._gauges = [Gauge(each, self._trackers) for each in measures]
        self._users = _users((each, each.claims) for each in self._watched)
        self._readers = _users((each, each.claims) for each in self._gauges)
        self._routes: dict[ActorLike, Route] = {}
        self.late_after: int | None = None
        """Time until which nothing is late; it may be too early."""
        self.happened: list[FactTracker] = []
        """Facts that the next line ends."""
        self._last: deque[LineLike] = deque(maxlen=REMEMBERED)
        self._begun = False

    @property
    def has_begun(self) -> bool:
        """Return True after the first step, when all machines have started."""
        return self._begun

    @property
    def due(self) -> int | None:
        """Time after which `advance` must be called, unless a line comes before.

        Something may then be late, or the first moment over.
        """
        return self.late_after if self._begun else START

    def see(self, line: LineLike) -> None:
        """Process a line; those of the start are one step."""
        if not self._begun and (line.event is not None or line.time > START):
            self._begin()
        if self.late_after is not None and line.time > self.late_after:
            self._let_pass(line.time)
        changed: dict[FactTracker, set[str | None]] = {}
        if self._begun:
            for tracker in self.happened:
                changed.setdefault(tracker, set()).update(tracker.reset())
            self.happened = []
        actor = line.actor
        route = self._routes.get(actor)
        if route is None:
            route = self._join(actor)
        moves = False
        for tracker in route.trackers_of(line):
            happens = tracker.see(line) or (tracker.momentary and tracker.holding)
            if happens:
                changed.setdefault(tracker, set()).add(actor.robot.name)
                moves = True
                if tracker.momentary:
                    self.happened.append(tracker)
        if moves:
            self._last.append(line)
        if not self._begun or not changed:
            return
        for gauge in _affected(self._readers, changed):
            gauge.step(line.time, gauge.claims.affected(changed, gauge.robots))
        for each in _affected(self._users, changed):
            robots = each.claims.affected(changed, each.robots)
            self._note(each, each.step(line.time, robots), line.time)
            if each.due is not None and (self.late_after is None or each.due < self.late_after):
                self.late_after = each.due
        self._look_whether_to_stop()

    def advance(self, time: int) -> None:
        """Let time pass without a line."""
        if not self._begun and time > START:
            self._begin()
        if self.late_after is not None and time > self.late_after:
            self._let_pass(time)
            self._look_whether_to_stop()

    def interest(self, actor: ActorLike) -> Interest:
        """Return what can change a fact in the lines of a machine."""
        trackers = self._trackers.following(actor)
        names = {act: {each.name for each in trackers if each.act == act} for act in ACTS}
        states = {
            state for name in names["in"] for state in meant_states(actor.states, name.split("."))
        }
        return Interest(
            heard=frozenset(names["hears"] | names["arrives"]),
            states=frozenset(states),
            acts=frozenset(
                (what, name)
                for act, what in (
                    ("sends", "sent"),
                    ("starts", "started"),
                    ("cancels", "cancelled"),
                )
                for name in names[act]
            ),
            values=any(each.act == "has" for each in trackers),
        )

    def results(self, time: int, *, ended: bool) -> list[PropertyResult]:
        """Return the verdicts at the end of a run."""
        if not self._begun:
            self._begin()
        found = []
        for each in self._watched:
            verdicts = each.finish(time, ended=ended)
            self._note(each, each.newly_violated(each.robots), time)
            worst = next((v for v in (FALSE, OPEN) if v in verdicts.values()), TRUE)
            robots = tuple(name for name, v in verdicts.items() if v == worst and name is not None)
            violations = tuple(v for v in self.violations if v.property is each.property)
            remark = each.remark if worst == TRUE else ""
            found.append(PropertyResult(each.property, worst, robots, violations, remark))
        return found

    def readings(self, time: int, limit: int | None = None) -> list[Reading]:
        """Return the values of the measures at a time; the run could last until the limit."""
        if not self._begun:
            self._begin()
        return [each.read(time, limit) for each in self._gauges]

    def _join(self, actor: ActorLike) -> Route:
        """Follow a machine from its first line on."""
        route = self._routes[actor] = Route(self._trackers.following(actor))
        for each in self._watched:
            each.join(actor)
        for gauge in self._gauges:
            gauge.join(actor)
        return route

    def _begin(self) -> None:
        """Take the first step, when all machines have started."""
        self._begun = True
        for gauge in self._gauges:
            gauge.step(0, gauge.robots)
        for each in self._watched:
            self._note(each, each.step(0, each.robots), 0)
        self.late_after = min(
            (each.due for each in self._watched if each.due is not None), default=None
        )

    def _let_pass(self, time: int) -> None:
        for each in self._watched:
            if each.due is not None and time > each.due:
                self._note(each, each.advance(time), time)
        self.late_after = min(
            (each.due for each in self._watched if each.due is not None), default=None
        )

    def _note(
        self, watched: _Watched, violated: Iterable[tuple[str | None, int]], now: int
    ) -> None:
        for robot, time in violated:
            now = min(now, time)
            last = tuple(self._last)
            self.violations.append(Violation(watched.property, robot, time, last))
        if self._told is not None and watched.state != watched.told:
            watched.told = watched.state
            self._told(watched.property, watched.state, now)

    def _look_whether_to_stop(self) -> None:
        if self._stops and any(each.property.chance is None for each in self.violations):
            raise ViolatedError


U = TypeVar("U")


def _users(sentences: Iterable[tuple[U, Claims]]) -> dict[FactTracker, list[U]]:
    """Return, for each tracker, what uses it."""
    found: dict[FactTracker, list[U]] = {}
    for user, claims in sentences:
        for tracker in claims.trackers:
            found.setdefault(tracker, []).append(user)
    return found


def _affected(users: Mapping[FactTracker, list[U]], changed: Iterable[FactTracker]) -> Iterable[U]:
    return {user: None for tracker in changed for user in users.get(tracker, ())}


class _Watched:
    """Monitors of one property: one, or one for each robot of a role."""

    def __init__(self, property_: Property, trackers: Trackers) -> None:
        self.property = property_
        self.claims = Claims(property_.each, trackers)
        self.told: Verdict | None = None
        """Verdict so far that has been told last."""
        self._scope = [self.claims.truth(each) for each in property_.scope]
        self._claims = [self.claims.truth(each) for each in property_.claims]
        momentary = is_momentary(property_.claims[0])
        self._sentence = replace(property_.sentence, momentary=momentary)
        self._monitors: dict[str | None, Monitor] = {}
        if property_.each is None:
            self._monitors[None] = self._monitor()
        self._violators: set[str | None] = set()
        self.due: int | None = None
        """Time before which nothing is late; it may be too early."""

    @property
    def robots(self) -> Collection[str | None]:
        """Robots that have a monitor; None for the one of all of them."""
        return self._monitors

    def join(self, actor: ActorLike) -> None:
        """Follow a machine from its first line on."""
        robot = actor.robot
        if robot.role == self.property.each and robot.name not in self._monitors:
            self._monitors[robot.name] = self._monitor()

    def step(self, time: int, robots: Iterable[str | None]) -> Iterable[tuple[str | None, int]]:
        """Take a step; return the robots that violate the property now, with the times."""
        monitors, claims, scope = self._monitors, self._claims, self._scope
        violated = False
        for robot in robots:
            monitor = monitors[robot]
            if not monitor.decided:
                parts = [truth(robot) for truth in scope] if scope else ()
                monitor.step(time, [truth(robot) for truth in claims], parts)
                if monitor.violated is not None:
                    violated = True
                else:
                    due = monitor.due
                    if due is not None and (self.due is None or due < self.due):
                        self.due = due
        return self.newly_violated(robots) if violated else ()

    def advance(self, time: int) -> Iterator[tuple[str | None, int]]:
        """Let time pass, likewise."""
        for monitor in self._monitors.values():
            monitor.advance(time)
        dues = (monitor.due for monitor in self._monitors.values())
        self.due = min((due for due in dues if due is not None), default=None)
        return self.newly_violated(self.robots)

    @property
    def state(self) -> Verdict:
        """The worst verdict so far."""
        states = {monitor.state for monitor in self._monitors.values()}
        return next((each for each in (FALSE, OPEN) if each in states), TRUE)

    @property
    def remark(self) -> str:
        """Return why the property says nothing of the run, for no robot."""
        remarks = {monitor.remark for monitor in self._monitors.values()}
        if not remarks:
            return "there was no robot"
        return "" if "" in remarks else min(remarks)

    def finish(self, time: int, *, ended: bool) -> Mapping[str | None, Verdict]:
        """Return the verdicts by robot."""
        return {
            robot: monitor.finish(time, ended=ended) for robot, monitor in self._monitors.items()
        }

    def newly_violated(self, robots: Iterable[str | None]) -> Iterator[tuple[str | None, int]]:
        """Yield those robots that violated the property since this was asked last."""
        for robot in robots:
            monitor = self._monitors[robot]
            if monitor.violated is not None and robot not in self._violators:
                self._violators.add(robot)
                yield robot, monitor.violated

    def _monitor(self) -> Monitor:
        return Monitor(self._sentence)
