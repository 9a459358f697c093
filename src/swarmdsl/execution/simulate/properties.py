"""Properties of a model, watched in a run."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.execution.monitor import FALSE, OPEN, TRUE, Monitor, Sentence, Verdict
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.expressions import function_of
from swarmdsl.execution.simulate.facts import Data, FactTracker, Route
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.ir import Claim, Count, Fact, Junction, Property, Robots
from swarmdsl.ir.operations import OPERATIONS
from swarmdsl.ir.sentences import facts_in

REMEMBERED = 8
"""Number of trace lines kept with a violation."""

Truth = Callable[[str | None], bool]
"""Truth of a claim, for the robot of `each`."""


@dataclass(frozen=True)
class Violation:
    """Violation of a property, by a robot if it is about each one, with the last trace lines."""

    property: Property
    robot: str | None
    time: int
    last: tuple[Line, ...]


@dataclass(frozen=True)
class PropertyResult:
    """Verdict on a property at the end of a run; `robots` are those with the same verdict."""

    property: Property
    verdict: Verdict
    robots: tuple[str, ...]
    violations: tuple[Violation, ...]


class ViolatedError(Exception):
    """A property is violated, and the run must stop then."""


def watchable(subject: Subject) -> list[Property]:
    """Return the properties that are about the subject of a run."""
    system = subject.system
    found = system.properties if system is not None and subject.document is None else ()
    return [each for each in found if each.subject == subject.name]


class Watch:
    """Monitors of some properties in one run, a listener of its trace."""

    def __init__(
        self,
        properties: Sequence[Property],
        cast: Sequence[Actor],
        data: Data,
        *,
        stops: bool = False,
        keeps_history: bool = False,
    ) -> None:
        self.violations: list[Violation] = []
        self._trackers: dict[tuple[object, ...], FactTracker] = {}
        self._cast, self._data = cast, data
        self._stops = stops
        self._keeps_history = keeps_history
        self.history: dict[str, list[tuple[int, Verdict]]] = {}
        """Verdicts so far of each property, with the times from which on they held."""
        self._watched = [_Watched(each, self) for each in properties]
        self._users: dict[FactTracker, list[_Watched]] = {}
        for each in self._watched:
            for tracker in each.trackers:
                self._users.setdefault(tracker, []).append(each)
        self._routes = {
            actor: Route([each for each in self._trackers.values() if each.follows(actor)])
            for actor in cast
        }
        self._due: int | None = None
        """Time before which nothing is late; it may be too early."""
        self._happened: list[FactTracker] = []
        self._last: deque[Line] = deque(maxlen=REMEMBERED)
        self._begun = False

    def see(self, line: Line) -> None:
        """Process a line; those of the start are one step."""
        if not self._begun and line.event is not None:
            self._begin()
        if self._due is not None and line.time > self._due:
            for each in self._watched:
                if each.due is not None and line.time > each.due:
                    self._note(each, each.advance(line.time), line.time)
            self._due = min(
                (each.due for each in self._watched if each.due is not None), default=None
            )
        self._last.append(line)
        changed: dict[FactTracker, set[str | None]] = {}
        if self._begun:
            for tracker in self._happened:
                changed[tracker] = tracker.reset()
            self._happened = []
        for tracker in self._routes[line.actor].trackers_of(line):
            happens = tracker.see(line) or (tracker.momentary and tracker.holding)
            if happens:
                changed.setdefault(tracker, set()).add(line.actor.robot.name)
                if tracker.momentary:
                    self._happened.append(tracker)
        if not self._begun or not changed:
            return
        affected = {user: None for tracker in changed for user in self._users.get(tracker, ())}
        for each in affected:
            robots = each.affected(changed)
            self._note(each, each.step(line.time, robots), line.time)
            if each.due is not None and (self._due is None or each.due < self._due):
                self._due = each.due
        if self._stops and any(each.property.chance is None for each in self.violations):
            raise ViolatedError

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
            found.append(PropertyResult(each.property, worst, robots, violations))
        return found

    def tracker(self, fact: Fact | Count, robots: Sequence[Actor]) -> FactTracker:
        """Return the tracker of a fact, shared by all properties."""
        role = robots[0].robot.role if robots else ""
        act, name = ("in", fact.state) if isinstance(fact, Count) else (fact.act, fact.name)
        key = (act, name, role, fact.guard if isinstance(fact, Fact) else None, len(robots))
        if key not in self._trackers:
            self._trackers[key] = FactTracker(fact, robots, self._data)
        return self._trackers[key]

    def robots(self, role: str | None) -> list[Actor]:
        """Return the actors of a role, or all of them."""
        return [actor for actor in self._cast if role is None or actor.robot.role == role]

    def _begin(self) -> None:
        """Take the first step, when all machines have started."""
        self._begun = True
        for each in self._watched:
            self._note(each, each.step(0, each.robots), 0)
        self._due = min((each.due for each in self._watched if each.due is not None), default=None)

    def _note(
        self, watched: _Watched, violated: Iterator[tuple[str | None, int]], now: int
    ) -> None:
        for robot, time in violated:
            now = min(now, time)
            last = tuple(self._last)
            self.violations.append(Violation(watched.property, robot, time, last))
        if self._keeps_history:
            known = self.history.setdefault(watched.property.name, [])
            if not known or known[-1][1] != watched.state:
                known.append((now, watched.state))


class _Watched:
    """Monitors of one property: one, or one for each robot of a role."""

    def __init__(self, property_: Property, watch: Watch) -> None:
        self.property = property_
        self.trackers: dict[FactTracker, None] = {}
        self._shared: set[FactTracker] = set()
        """Facts that are not only about the robot of `each`."""
        self._watch = watch
        scope = property_.scope
        self._scope = [self._truth(each) for each in scope.claims] if scope is not None else []
        self._claims = [self._truth(each) for each in property_.claims]
        within = property_.within
        first = facts_in(property_.claims[0])
        sentence = Sentence(
            property_.kind,
            scope.kind if scope is not None else None,
            None if within is None else int(function_of(within)({}, None)),
            property_.times,
            momentary=any(watch.tracker(*self._about(each)).momentary for each in first),
        )
        self.robots: list[str | None] = [None]
        if property_.each is not None:
            actors = watch.robots(property_.each)
            self.robots = list(dict.fromkeys(actor.robot.name for actor in actors))
        self._monitors = {robot: Monitor(sentence) for robot in self.robots}
        self._told: set[str | None] = set()
        self.due: int | None = None
        """Time before which nothing is late; it may be too early."""

    def affected(self, changed: Mapping[FactTracker, set[str | None]]) -> Iterable[str | None]:
        """Return the robots whose monitors must take a step."""
        if self.property.each is None or not self._shared.isdisjoint(changed):
            return self.robots
        robots = set().union(*(changed[each] for each in self.trackers if each in changed))
        return [robot for robot in robots if robot in self._monitors]

    def step(self, time: int, robots: Iterable[str | None]) -> Iterator[tuple[str | None, int]]:
        """Take a step; return the robots that violate the property now, with the times."""
        for robot in robots:
            monitor = self._monitors[robot]
            if not monitor.decided:
                scope = [truth(robot) for truth in self._scope]
                monitor.step(time, [truth(robot) for truth in self._claims], scope)
                if monitor.due is not None and (self.due is None or monitor.due < self.due):
                    self.due = monitor.due
        return self.newly_violated(robots)

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

    def finish(self, time: int, *, ended: bool) -> Mapping[str | None, Verdict]:
        """Return the verdicts by robot."""
        return {
            robot: monitor.finish(time, ended=ended) for robot, monitor in self._monitors.items()
        }

    def newly_violated(self, robots: Iterable[str | None]) -> Iterator[tuple[str | None, int]]:
        """Yield those robots that violated the property since this was asked last."""
        for robot in robots:
            monitor = self._monitors[robot]
            if monitor.violated is not None and robot not in self._told:
                self._told.add(robot)
                yield robot, monitor.violated

    # ---- claims

    def _truth(self, claim: Claim) -> Truth:
        if isinstance(claim, Junction):
            parts = [self._truth(each) for each in claim.claims]
            if claim.operator == "not":
                (part,) = parts
                return lambda me: not part(me)
            together = all if claim.operator == "and" else any
            return lambda me: together(part(me) for part in parts)
        tracker = self._watch.tracker(*self._about(claim))
        self.trackers[tracker] = None
        if isinstance(claim, Count):
            self._shared.add(tracker)
            compare, number = OPERATIONS[claim.comparison], claim.number
            return lambda me: bool(compare(len(tracker.holding), number))
        if claim.robots is None and claim.act != "arrives" and self.property.each is not None:
            return lambda me: me in tracker.holding
        self._shared.add(tracker)
        if claim.robots is not None:
            return _of_robots(claim.robots, tracker)
        return lambda me: bool(tracker.holding)

    def _about(self, claim: Fact | Count) -> tuple[Fact | Count, list[Actor]]:
        """Return a fact with the actors of its robots."""
        role = self.property.each
        if isinstance(claim, Count):
            role = claim.role
        elif claim.act == "arrives":
            role = None
        elif claim.robots is not None:
            role = claim.robots.role
        return claim, self._watch.robots(role)


def _of_robots(robots: Robots, tracker: FactTracker) -> Truth:
    if robots.quantifier == "index":
        name = f"{robots.role}[{robots.index or 0}]"
        return lambda me: name in tracker.holding
    if robots.quantifier == "number":
        assert robots.number is not None
        least, most = robots.number.lower, robots.number.upper
        return lambda me: (
            least <= len(tracker.holding) and (most is None or len(tracker.holding) <= most)
        )

    def count(me: str | None) -> int:
        return len(tracker.holding) - (robots.other and me in tracker.holding)

    if robots.quantifier == "some":
        return lambda me: count(me) > 0
    if robots.quantifier == "no":
        return lambda me: count(me) == 0
    return lambda me: count(me) == len(tracker.robots) - (robots.other and me in tracker.robots)
