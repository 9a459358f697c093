"""Properties and measures of one run, from the lines of its trace to verdicts and values."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable
from typing import Any

from .automaton import NEVER
from .claims import Property
from .facts import LOST, ActorLike, Has, Kind, LineLike
from .joint import Leap, Stand
from .meters import Reading
from .monitor import FALSE, OPEN, TRUE, Verdict
from .outcomes import PropertyResult, ViolatedError, Violation
from .plan import Plan
from .progress import Followed, Measured, Steps, Violators, Watched
from .truth import Roll

REMEMBERED = 8
"""Number of trace lines kept with a violation, of those that changed a fact."""
START = 5_000_000_000
"""Time in nanoseconds in which machines start at one moment if nothing else happens."""


class Watch:
    """Monitors of properties and gauges of measures in one run, a listener of its trace.

    Lines come in the order of time. Those that change no fact can be left out, except for the
    first one of a machine, its loss, and the next one of all after something `happened`; if all
    machines begin at the start, also those that change none that is `wanted`. `has` evaluates
    conditions; `told` is called with a property, its verdict so far, and the time from which on it
    holds. With `stops`, a violation raises ViolatedError, unless the property has a chance.
    """

    def __init__(
        self,
        plan: Plan,
        has: Has,
        *,
        stops: bool = False,
        told: Callable[[Property, Verdict, int], None] | None = None,
    ) -> None:
        self.plan = plan
        self.violations: list[Violation] = []
        self.has = has
        self.open: Callable[[Any], Any] = _itself
        """Return the line of a record."""
        self._stops = stops
        self._told = told
        self._roll = Roll()
        self._watched = [Watched(each, self._roll) for each in plan.rules]
        self._measured = [Measured(each, self._roll) for each in plan.gauges]
        self._every: list[Watched | Measured] = [*self._watched, *self._measured]
        self._of_swarm: list[Watched | Measured] = [
            *(self._watched[n] for n in plan.swarm_rules),
            *self._measured,
        ]
        self._robots: dict[str | None, Followed] = {}
        self._joined: dict[ActorLike, tuple[Followed, Kind]] = {}
        self._plain: dict[ActorLike, Followed] = {}
        """Robots with one machine, which has begun; a loss takes it out."""
        self.late_after = -1
        """Time until which nothing is late; it may be too early, and is before the first step."""
        self.happened: dict[Followed, int] = {}
        """Facts that the next line ends."""
        self.wanted = -1
        """Facts on which a verdict or a measure can still depend."""
        self._common = -1
        """Those of them that are not only in joint automata; all if all steps are told."""
        self._about = plan.known
        self._momentary = plan.facts.momentary
        self._lasting = ~self._momentary
        self._last: deque[Any] = deque(maxlen=REMEMBERED)
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
        if not self._begun:
            return START
        return self.late_after if self.late_after != NEVER else None

    def see(self, line: LineLike) -> None:
        """Process a line; those of the start are one step."""
        actor = line.actor
        _, kind = self._joined.get(actor) or self._join(actor)
        self.take(line.time, actor, line.event, kind.holding(line, self.has), line)

    def take(
        self, time: int, actor: ActorLike, event: str | None, holding: int, record: Any
    ) -> None:
        """Process the step of a machine with an event, after which some facts hold for it.

        The `record` stands for the line in violations.
        """
        if time > self.late_after:
            self._attend(time, event)
        robot = self._plain.get(actor)
        if robot is None or event == LOST:
            robot, found = self._gather(actor, event, holding, record)
            if found is None:
                return
            leap = found
        else:
            stand = robot.stand or self._stand(robot)
            leap = stand.leaps.get(holding) or self._leap(robot, stand, holding)
        over = self.happened
        if leap.moment:
            self.happened = {robot: leap.moment}
        elif over:
            self.happened = {}
        stand = robot.stand = leap.target
        robot.bits = stand.bits
        if leap.counts:
            self._roll.count(robot.name, leap.gained, leap.lost)
        for number, state in leap.silent:
            self._watched[number].states[robot.name] = state
        if leap.different & self.wanted:
            self._last.append(record)
        if over:
            self._step(time, self._forget(over, robot, leap))
        elif leap.moves or leap.facts & self._common:
            self._step(time, ((robot, leap),))

    def _attend(self, time: int, event: str | None) -> None:
        """Take the first step with the first event or late enough; look at what is late."""
        if not self._begun and (event is not None or time > START):
            self._begin()
        if self._begun and time > self.late_after:
            self._let_pass(time)

    def _gather(
        self, actor: ActorLike, event: str | None, holding: int, record: Any
    ) -> tuple[Followed, Leap | None]:
        """Return the robot of a machine with its step, which it does not take before the first."""
        robot, kind = self._joined.get(actor) or self._join(actor)
        more = 0
        if event == LOST:
            more, holding = self._roll.leave(robot, kind.mask, self.plan.shared_bits), 0
            self._plain.pop(actor, None)
        elif kind.mask & ~robot.there:
            more = self._roll.come(robot, kind.mask, self.plan.shared_bits)
        if robot.lasting is not None:
            if event == LOST:
                # Where one of its machines has ended before, the robot is not there, either.
                robot.lasting = dict.fromkeys(robot.lasting, 0)
            robot.lasting[actor] = holding & self._lasting
            for each in robot.lasting.values():
                holding |= each
        elif self._begun and event != LOST:
            self._plain[actor] = robot
        if not self._begun:
            self._start(robot, holding, more, record)
            return robot, None
        return robot, self._leap(robot, robot.stand or self._stand(robot), holding, more)

    def _start(self, robot: Followed, holding: int, more: int, record: Any) -> None:
        """Collect the facts of the start, which are those of one step."""
        before, moment = robot.bits, holding & self._momentary
        if moment:
            self.happened[robot] = self.happened.get(robot, 0) | moment
        robot.bits = holding | before & self._momentary
        new, gone = robot.bits & ~before, before & ~robot.bits
        self._roll.count(robot.name, self.plan.shared_bits(new), self.plan.shared_bits(gone))
        if (new | gone | moment | more) & self.wanted:
            self._last.append(record)

    def _stand(self, robot: Followed) -> Stand:
        """Return the place of a robot in its joint automaton."""
        joint = self.plan.joint(robot.role)
        states = tuple([self._watched[number].states[robot.name] for number in joint.numbers])
        return joint.at(robot.bits, states)

    def _leap(self, robot: Followed, stand: Stand, holding: int, more: int = 0) -> Leap:
        """Return the step of a robot after which some facts hold."""
        known = None if more else stand.leaps.get(holding)
        return known or self.plan.joint(robot.role).leap(stand, holding, more)

    def _forget(self, over: Iterable[Followed], robot: Followed, leap: Leap) -> Steps:
        """End what happened at the last moment, for others than a robot that takes a step itself.

        Return all steps.
        """
        steps = [(robot, leap)]
        for other in over:
            if other is not robot:
                stand, bits = other.stand or self._stand(other), other.bits & self._lasting
                leap = stand.leaps.get(bits) or self._leap(other, stand, bits)
                other.stand, other.bits = leap.target, bits
                if leap.counts:
                    self._roll.count(other.name, leap.gained, leap.lost)
                for number, state in leap.silent:
                    self._watched[number].states[other.name] = state
                steps.append((other, leap))
        return steps

    def _step(self, time: int, steps: Steps) -> None:
        """Let some robots take a step."""
        found: dict[int, list[tuple[str | None, int]]] = {}
        facts = 0
        for robot, leap in steps:
            facts |= leap.facts
            for number, move in leap.moves:
                violators = found.setdefault(number, [])
                self._watched[number].take(robot.name, move, time, violators)
        if facts & self._common:
            sentences, gauges = self._about.get(facts) or self.plan.about(facts)
            for number in gauges:
                gauge = self._measured[number]
                gauge.step(time, gauge.affected(facts, steps))
            for number in sentences:
                each = self._watched[number]
                if each.robots:
                    if each.each is None:
                        violated = each.step_alone(time)
                    else:
                        violated = each.step(time, each.affected(facts, steps))
                    if violated is not None:
                        found[number] = violated
        if self._told is not None:
            for number, rule in enumerate(self.plan.rules):
                if rule.claims.mask & facts and self._watched[number].robots:
                    found.setdefault(number, [])
        if found:
            for number in sorted(found):
                self._judge(self._watched[number], found[number], time)
        if self._stops and self.violations:
            self._look_whether_to_stop()

    def _judge(self, watched: Watched, violators: Violators, time: int) -> None:
        """Note what a step says of a property."""
        if violators or self._told is not None:
            self._note(watched, violators, time)
        if not watched.robots:
            self._look_what_matters()
        due = watched.due
        if due is not None and due < self.late_after:
            self.late_after = due

    def advance(self, time: int) -> None:
        """Let time pass without a line."""
        if time > self.late_after:
            self._attend(time, None)
            self._look_whether_to_stop()

    def verdict(self, name: str, robot: str | None, time: int) -> Verdict:
        """Return the verdict so far on a property, of a robot if it is about each one."""
        self._begin()
        self.advance(time)
        watched = next(each for each in self._watched if each.rule.property.name == name)
        return watched.states[robot].verdict

    def results(self, time: int, *, ended: bool) -> list[PropertyResult]:
        """Return the verdicts at the end of a run."""
        self._begin()
        found = []
        for each in self._watched:
            self._note(each, each.advance(time), time)
            verdicts, violated = each.finish(time, ended=ended)
            self._note(each, violated, time)
            property_ = each.rule.property
            worst = next((v for v in (FALSE, OPEN) if v in verdicts.values()), TRUE)
            names = tuple(name for name, v in verdicts.items() if v == worst and name is not None)
            violations = tuple(v for v in self.violations if v.property is property_)
            remark = each.remark if worst == TRUE else ""
            found.append(PropertyResult(property_, worst, names, violations, remark))
        for robot in self._robots.values():
            robot.stand = None
        return found

    def readings(self, time: int, limit: int | None = None) -> list[Reading]:
        """Return the values of the measures at a time; the run could last until the limit."""
        self._begin()
        return [each.gauge.read(each.meters.values(), time, limit) for each in self._measured]

    def _join(self, actor: ActorLike) -> tuple[Followed, Kind]:
        """Follow a machine from its first line on."""
        name, role = actor.robot.name, actor.robot.role
        robot = self._robots.setdefault(name, Followed(name, role))
        if robot.first is None:
            robot.first = actor
        elif robot.lasting is None:
            robot.lasting = {robot.first: robot.bits & ~self._momentary}
            self._plain.pop(robot.first, None)
        found = self._joined[actor] = robot, self.plan.kind(actor)
        for each in self._every:
            if each.each == role:
                each.join(robot)
        if self._begun:
            self._look_what_matters()
        return found

    def _look_what_matters(self) -> None:
        """Note the facts on which something can still depend."""
        self.wanted = self._common = 0
        for each in self._every:
            if each.robots or each.can_grow:
                self.wanted |= each.mask
        for each in self._of_swarm:
            if each.robots or each.can_grow:
                self._common |= each.mask
        if self._told is not None:
            self._common = -1

    def _begin(self) -> None:
        """Take the first step, when all machines have started, unless it was taken."""
        if self._begun:
            return
        self._begun = True
        for gauge in self._measured:
            gauge.step(0, gauge.robots.values())
        for each in self._watched:
            self._note(each, each.step(0, [*each.robots.values()]) or (), 0)
        self._look_what_matters()
        dues = [each.due for each in self._watched if each.due is not None]
        self.late_after = min(dues, default=NEVER)

    def _let_pass(self, time: int) -> None:
        for each in self._watched:
            if each.due is not None and time > each.due:
                self._note(each, each.advance(time), time)
                if not each.robots:
                    self._look_what_matters()
        dues = [each.due for each in self._watched if each.due is not None]
        self.late_after = min(dues, default=NEVER)

    def _note(self, watched: Watched, violators: Violators, now: int) -> None:
        property_ = watched.rule.property
        for robot, time in violators:
            now = min(now, time)
            last = tuple(map(self.open, self._last))
            self.violations.append(Violation(property_, robot, time, last))
        if self._told is not None and watched.state != watched.told:
            watched.told = watched.state
            self._told(property_, watched.state, now)

    def _look_whether_to_stop(self) -> None:
        if self._stops and any(each.property.chance is None for each in self.violations):
            raise ViolatedError


def _itself(line: Any) -> Any:
    return line
