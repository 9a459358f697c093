"""Progress of a property or a measure in one run, about one robot or about each of a role."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence

from .automaton import Move, State
from .facts import ActorLike
from .joint import Leap, Stand
from .meters import Gauge, Meter
from .monitor import FALSE, OPEN, TRUE, Verdict
from .rule import Rule
from .truth import Claims, Roll

Violators = Sequence["tuple[str | None, int]"]
"""Robots that violate a property, with the times."""


class Followed:
    """Robot with the facts that hold for it, in `bits`; `first` is its first machine."""

    def __init__(self, name: str | None, role: str = "") -> None:
        self.name = name
        self.role = role
        self.bits = 0
        self.stand: Stand | None = None
        """Place in the joint automaton of its role, if it is known."""
        self.there = 0
        """Facts about its machines that have started and are not lost."""
        self.lasting: dict[Hashable, int] | None = None
        """Facts that last, by machine, if there are several."""
        self.first: ActorLike | None = None


Steps = Sequence["tuple[Followed, Leap]"]
"""Robots with their steps at one moment."""


class Progress:
    """State of a sentence or a measure in a run, about one robot or about each."""

    def __init__(self, each: str | None, claims: Claims, roll: Roll) -> None:
        self.each = each
        self.shared = claims.shared
        self.mask = claims.mask
        self.robots: dict[str | None, Followed] = {}
        """Robots about which a step can change something; None stands for all together."""
        self._claims = claims
        self._roll = roll

    def affected(self, facts: int, steps: Steps) -> Iterable[Followed]:
        """Return the robots for which a claim can have changed, with the facts that have."""
        if facts & self.shared:
            return self.robots.values()
        mask, known = self.mask, self.robots
        return [robot for robot, leap in steps if leap.facts & mask and robot.name in known]


class Measured(Progress):
    """Meters of a measure in a run: one, or one for each robot of a role."""

    def __init__(self, gauge: Gauge, roll: Roll) -> None:
        super().__init__(gauge.each, gauge.claims, roll)
        self.gauge = gauge
        self.can_grow = True
        self.meters: dict[str | None, Meter] = {}
        if self.each is None:
            self.join(Followed(None))

    def join(self, robot: Followed) -> None:
        """Measure something of a robot; one without a name stands for all together."""
        if robot.name in self.meters:
            return
        self.robots[robot.name] = robot
        self.meters[robot.name] = self.gauge.meter()

    def step(self, time: int, robots: Iterable[Followed]) -> None:
        """Take a step, in which the claim can have changed for these robots."""
        for robot in robots:
            number = self.gauge.number(robot.bits, self._roll, robot.name)
            self.meters[robot.name].step(time, number)


class Watched(Progress):
    """States of the automaton of a property in a run: one, or one for each robot of a role."""

    def __init__(self, rule: Rule, roll: Roll) -> None:
        super().__init__(rule.each, rule.claims, roll)
        self.rule = rule
        self.can_grow = self.each is not None and bool(self.shared & ~rule.facts.momentary)
        """True if a robot that comes later would depend on what was before."""
        self.states: dict[str | None, State] = {}
        self.told: Verdict | None = None
        """Verdict so far that has been told last."""
        self.due: int | None = None
        """Time before which nothing is late; it may be too early."""
        self._dues: dict[str | None, int] = {}
        if self.each is None:
            self.join(Followed(None))

    def join(self, robot: Followed) -> None:
        """Watch a robot; one without a name stands for all together."""
        if robot.name in self.states:
            return
        self.robots[robot.name] = robot
        self.states[robot.name] = self.rule.automaton.first

    def step(self, time: int, robots: Iterable[Followed]) -> list[tuple[str | None, int]] | None:
        """Take a step; return the robots that violate it now, None if no automaton has moved."""
        states, roll, claims = self.states, self._roll, self._claims
        own, quantified = claims.own, claims.quantified
        moved: list[tuple[str | None, Move]] = []
        for robot in robots:
            name = robot.name
            state = states[name]
            # As `Claims.key`, without a call for each of what may be millions.
            key = robot.bits & own
            for holds in quantified:
                key = key << 1 | holds(roll, name)
            move = state.moves.get(key) or self.rule.move(state, key)
            if move is not state.stay:
                moved.append((name, move))
        if not moved:
            return None
        violated: list[tuple[str | None, int]] = []
        for name, move in moved:
            self.take(name, move, time, violated)
        return violated

    def step_alone(self, time: int) -> list[tuple[str | None, int]] | None:
        """Take a step in a sentence that is not about each robot, likewise."""
        key, roll, state = 0, self._roll, self.states[None]
        for holds in self._claims.quantified:
            key = key << 1 | holds(roll, None)
        move = state.moves.get(key) or self.rule.move(state, key)
        if move is state.stay:
            return None
        violated: list[tuple[str | None, int]] = []
        self.take(None, move, time, violated)
        return violated

    def take(
        self, name: str | None, move: Move, time: int, violated: list[tuple[str | None, int]]
    ) -> None:
        """Go to another state for a robot; add it to those that violate the property now."""
        state = self.states[name] = move.target
        if move.begins:
            due = self._dues[name] = time + self.rule.automaton.within
            self.due = due if self.due is None else min(self.due, due)
        elif not state.is_timed:
            self._dues.pop(name, None)
        if state.is_violated:
            violated.append((name, time))
        if self.rule.automaton.is_final(state):
            self.robots.pop(name, None)

    def advance(self, time: int) -> Violators:
        """Let time pass, likewise."""
        violated = []
        for name, due in [(name, due) for name, due in self._dues.items() if time > due]:
            state = self.states[name] = self.rule.automaton.late(self.states[name])
            self.robots[name].stand = None
            del self._dues[name]
            if state.is_violated:
                violated.append((name, due))
            if self.rule.automaton.is_final(state):
                del self.robots[name]
        self.due = min(self._dues.values(), default=None)
        return violated

    def finish(self, time: int, *, ended: bool) -> tuple[Mapping[str | None, Verdict], Violators]:
        """Return the verdicts by robot, and the robots that violate the property in the end."""
        verdicts: dict[str | None, Verdict] = {}
        violated = []
        for name, state in self.states.items():
            verdicts[name], last = self.rule.automaton.end(state, ended=ended)
            self.states[name] = last
            if last.is_violated and not state.is_violated:
                violated.append((name, time))
        return verdicts, violated

    @property
    def state(self) -> Verdict:
        """The worst verdict so far."""
        verdicts = {state.verdict for state in self.states.values()}
        return next((each for each in (FALSE, OPEN) if each in verdicts), TRUE)

    @property
    def remark(self) -> str:
        """Return why the property says nothing of the run, for no robot."""
        remarks = {state.monitor.remark for state in self.states.values()}
        if not remarks:
            return "there was no robot"
        return "" if "" in remarks else min(remarks)
