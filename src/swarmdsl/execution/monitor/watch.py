"""Properties and measures of one run, from the lines of its trace to verdicts and values."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

from .claims import Property
from .facts import LOST, ActorLike, Has, Kind, LineLike
from .meters import Reading
from .monitor import FALSE, OPEN, TRUE, Verdict
from .plan import Plan
from .progress import Followed, Measured, Watched
from .truth import Roll

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


class ViolatedError(Exception):
    """A property is violated, and the run must stop then."""


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
        self._stops = stops
        self._told = told
        self._roll = Roll()
        self._watched = [Watched(each, self._roll) for each in plan.rules]
        self._measured = [Measured(each, self._roll) for each in plan.gauges]
        self._every: list[Watched | Measured] = [*self._watched, *self._measured]
        self._robots: dict[str | None, Followed] = {}
        self._joined: dict[ActorLike, tuple[Followed, Kind]] = {}
        self.late_after: int | None = None
        """Time until which nothing is late; it may be too early."""
        self.happened: dict[Followed, int] = {}
        """Facts that the next line ends."""
        self.wanted = -1
        """Facts on which a verdict or a measure can still depend."""
        self._momentary = plan.facts.momentary
        self._shared = plan.shared
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

    def see(self, line: LineLike, holding: int | None = None) -> None:
        """Process a line; those of the start are one step.

        `holding` are the facts that hold for its machine after it, if they are known.
        """
        time = line.time
        if not self._begun and (line.event is not None or time > START):
            self._begin()
        if self.late_after is not None and time > self.late_after:
            self._let_pass(time)
        robot, kind = self._joined.get(line.actor) or self._join(line.actor)
        changed: dict[Followed, int] = {}
        if self.happened and self._begun:
            changed, self.happened = self.happened, changed
            self._forget(changed)
        if holding is None:
            holding = kind.holding(line, self.has)
        before, now, moment = robot.bits, holding, holding & self._momentary
        if robot.lasting is not None:
            robot.lasting[line.actor] = holding ^ moment
            for each in robot.lasting.values():
                now |= each
        if moment:
            self.happened[robot] = self.happened.get(robot, 0) | moment
        if not self._begun:
            now |= before & self._momentary
        robot.bits = now
        different = before ^ now | moment
        if line.event == LOST:
            different |= self._go(robot, kind)
        elif robot.there & kind.mask != kind.mask:
            different |= self._come(robot, kind)
        if different & self._shared:
            self._count(robot, different)
        different &= self.wanted
        if different:
            self._last.append(line)
            changed[robot] = changed.get(robot, 0) | different
        if changed and self._begun:
            self._step(time, changed)

    def _forget(self, over: Mapping[Followed, int]) -> None:
        """End the facts of the last moment."""
        for robot, bits in over.items():
            robot.bits &= ~bits
            if bits & self._shared:
                self._count(robot, bits)

    def _count(self, robot: Followed, facts: int) -> None:
        """Note for which of some facts a robot is one of those for which they hold."""
        for bit in self.plan.shared_bits(facts):
            if robot.bits & bit:
                self._roll.holding[bit].add(robot.name)
            else:
                self._roll.holding[bit].discard(robot.name)

    def _come(self, robot: Followed, kind: Kind) -> int:
        """Let facts about a robot count; return those for which this is new."""
        new = kind.mask & ~robot.there
        robot.there |= new
        for bit in self.plan.shared_bits(new):
            self._roll.there[bit].add(robot.name)
        return new

    def _go(self, robot: Followed, kind: Kind) -> int:
        """Let facts about a robot count no more; return those that did."""
        gone = kind.mask & robot.there
        robot.there ^= gone
        for bit in self.plan.shared_bits(gone):
            self._roll.there[bit].discard(robot.name)
        return gone

    def _step(self, time: int, changed: Mapping[Followed, int]) -> None:
        """Take a step, in which facts about some robots have changed."""
        facts = 0
        for bits in changed.values():
            facts |= bits
        sentences, gauges = self.plan.about(facts)
        for number in gauges:
            gauge = self._measured[number]
            gauge.step(time, gauge.affected(facts, changed))
        for number in sentences:
            each = self._watched[number]
            if not each.robots:
                continue
            violated = each.step(time, each.affected(facts, changed))
            if violated or self._told is not None:
                self._note(each, violated, time)
            if not each.robots:
                self._look_what_matters()
            due = each.due
            if due is not None and (self.late_after is None or due < self.late_after):
                self.late_after = due
        if self._stops:
            self._look_whether_to_stop()

    def advance(self, time: int) -> None:
        """Let time pass without a line."""
        if not self._begun and time > START:
            self._begin()
        if self.late_after is not None and time > self.late_after:
            self._let_pass(time)
            self._look_whether_to_stop()

    def results(self, time: int, *, ended: bool) -> list[PropertyResult]:
        """Return the verdicts at the end of a run."""
        if not self._begun:
            self._begin()
        found = []
        for each in self._watched:
            self._note(each, each.advance(time), time)
            verdicts, violated = each.finish(time, ended=ended)
            self._note(each, violated, time)
            property_ = each.rule.property
            worst = next((v for v in (FALSE, OPEN) if v in verdicts.values()), TRUE)
            robots = tuple(name for name, v in verdicts.items() if v == worst and name is not None)
            violations = tuple(v for v in self.violations if v.property is property_)
            remark = each.remark if worst == TRUE else ""
            found.append(PropertyResult(property_, worst, robots, violations, remark))
        return found

    def readings(self, time: int, limit: int | None = None) -> list[Reading]:
        """Return the values of the measures at a time; the run could last until the limit."""
        if not self._begun:
            self._begin()
        return [each.gauge.read(each.meters.values(), time, limit) for each in self._measured]

    def _join(self, actor: ActorLike) -> tuple[Followed, Kind]:
        """Follow a machine from its first line on."""
        name, role = actor.robot.name, actor.robot.role
        robot = self._robots.setdefault(name, Followed(name))
        if robot.first is None:
            robot.first = actor
        elif robot.lasting is None:
            robot.lasting = {robot.first: robot.bits & ~self._momentary}
        found = self._joined[actor] = robot, self.plan.kind(actor)
        for each in self._every:
            if each.each == role:
                each.join(robot)
        if self._begun:
            self._look_what_matters()
        return found

    def _look_what_matters(self) -> None:
        """Note the facts on which something can still depend."""
        self.wanted = 0
        for each in self._every:
            if each.robots or each.can_grow:
                self.wanted |= each.mask

    def _begin(self) -> None:
        """Take the first step, when all machines have started."""
        self._begun = True
        for gauge in self._measured:
            gauge.step(0, gauge.robots.values())
        for each in self._watched:
            self._note(each, each.step(0, each.robots.values()), 0)
        self._look_what_matters()
        self.late_after = min(
            (each.due for each in self._watched if each.due is not None), default=None
        )

    def _let_pass(self, time: int) -> None:
        for each in self._watched:
            if each.due is not None and time > each.due:
                self._note(each, each.advance(time), time)
                if not each.robots:
                    self._look_what_matters()
        self.late_after = min(
            (each.due for each in self._watched if each.due is not None), default=None
        )

    def _note(
        self, watched: Watched, violators: Iterable[tuple[str | None, int]], now: int
    ) -> None:
        property_ = watched.rule.property
        for robot, time in violators:
            now = min(now, time)
            last = tuple(self._last)
            self.violations.append(Violation(property_, robot, time, last))
        if self._told is not None and watched.state != watched.told:
            watched.told = watched.state
            self._told(property_, watched.state, now)

    def _look_whether_to_stop(self) -> None:
        if self._stops and any(each.property.chance is None for each in self.violations):
            raise ViolatedError
