"""A swarm of some size, ready for proofs: its automata, groups of robots, and what is doubtful."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.execution.engine import Event
from swarmdsl.execution.simulate.inputs.choose_space import has_places
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.members import DEPARTED, JOINED
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.verify.abstraction.alphabet import Alphabet
from swarmdsl.execution.verify.abstraction.demands import Demands
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.automata.automaton import Automaton
from swarmdsl.execution.verify.automata.closure import close
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.automata.quotient import Quotient
from swarmdsl.execution.verify.robot.environment import Environment, Options
from swarmdsl.execution.verify.robot.membership import crew_of
from swarmdsl.execution.verify.robot.robot_kind import Kind
from swarmdsl.execution.verify.robot.symmetry import activities, key_of
from swarmdsl.execution.verify.robot.unknown_senders import messages_to
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.machines import (
    FactsByRole,
    addressed,
    conditions,
    facts_by_role,
    sends,
)
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import facts_of, mask_of
from swarmdsl.execution.verify.swarm.uncovered import uncovered, uncovered_lifespans

MOST_STATES, MOST_MOVES = 500, 5_000
"""Maximum number of states, and of moves, of one robot that are looked at."""


class Model:
    """Automata of the robots of a subject, for given numbers of members.

    If it is of `only` one robot, all others may send it anything at any time. Conditions on the
    data that are `open` hold or not, each time.
    """

    def __init__(
        self,
        subject: Subject,
        counts: Mapping[str, int],
        properties: Sequence[ir.Property],
        options: Options,
        budget: Budget,
        report: Diagnostics,
        only: str | None = None,
        open_: tuple[str, ...] = (),
    ) -> None:
        assert subject.system is not None
        self.subject = subject
        self.system = subject.system
        self.properties = properties
        self.options = options
        self.counts = counts
        scenario = replace(options.scenario or Scenario(), counts=counts)
        robots = subject.create_robots(counts, scenario.alone)
        everybody = actors(subject, robots, scenario, report)
        self.cast = [each for each in everybody if only in (None, each.robot.name)]
        self._strangers = [each for each in everybody if each not in self.cast]
        self.open = open_
        self.kinds: list[Automaton] = []
        if report.has_errors:
            return
        self._by_robot: dict[str | None, list[Actor]] = {}
        for actor in self.cast:
            self._by_robot.setdefault(actor.robot.name, []).append(actor)
        self.machines = {
            machine.name: machine
            for actors_ in self._by_robot.values()
            for machine in (self.system.machines_by_name[a.machine.name] for a in actors_)
        }
        facts = facts_by_role(self.cast, properties)
        data: dict[str, list[Any]] = {}
        for actor in self.cast:
            data.setdefault(actor.machine.name, []).append({**actor.params, **actor.data})
        extra = conditions(self.cast, facts)
        self.demands = Demands(self.system, data, extra, lengths=options.exact)
        robots = list(dict.fromkeys(actor.robot for actor in everybody))
        self.environment = Environment(
            self.system,
            self.demands,
            options,
            robots,
            lambda names: self.sends(names or {each.machine.name for each in everybody}),
            has_places=has_places(scenario.world, subject, scenario),
        )
        self.alphabet = Alphabet(self.system, self.demands, is_cut=self.environment.is_cut)
        self.returns = any(map(self.environment.absences, robots))
        """True if a robot is lost for a time."""
        self._crew = crew_of(subject, robots, self.environment)
        self._doubts: dict[int, list[Doubt]] = {}
        self._addressees = set(addressed(self.machines.values()))
        self._robots: list[list[str | None]] = []
        self._gather(facts)
        self._quotients: dict[tuple[int, int, bool, bool], Quotient] = {}
        self._budget = budget
        self.wider: dict[Any, Model | None] = {}
        """Models with more runs, by what they leave open."""
        self.complete = close(self.kinds, self.alphabet, MOST_STATES, MOST_MOVES, budget)
        self._unfinished = [each for each in self.kinds if not each.is_complete]

    @property
    def outside(self) -> list[str]:
        """Events from outside."""
        return list(self.environment.outside)

    @property
    def silent(self) -> list[str]:
        """Functions that may never answer."""
        return sorted({name for kind in self.kinds for name in kind.kind.silent})

    @property
    def guesses(self) -> bool:
        """True if robots that follow who is there may lose sight of any other one."""
        return self._crew.guesses and any(self._follows(each.kind.cast) for each in self.kinds)

    # ---- groups

    def named(self, properties: Iterable[ir.Property]) -> set[str]:
        """Return the robots that the machines or some properties name."""
        return self._addressees | {
            f"{each.robots.role}[{each.robots.index or 0}]"
            for property_ in properties
            for each in facts_of(property_)
            if isinstance(each, ir.Fact)
            and each.robots is not None
            and each.robots.quantifier == "index"
        }

    def network(
        self,
        groups: Sequence[Group],
        *,
        base: int = 0,
        timed: bool = False,
        spared: str | None = None,
        eager: bool = False,
        lonely: bool = False,
    ) -> Network:
        """Return the network of some groups; with `timed`, runs must fit times in any case.

        A robot may be spared: it is not lost, unless it comes back. An `eager` network has only
        some of the runs, and so has a `lonely` one: those in which nobody is near.
        """
        options = self.options
        timing = options.timing if timed or options.exact else None
        return Network(
            groups,
            self.alphabet,
            options.capacity,
            lossy=self.environment.lossy,
            base=base,
            timing=timing,
            eager=eager,
            lonely=lonely,
            faults=self.environment.faults,
            spared=None if self.returns else spared,
            heartbeat=self.subject.heartbeat,
            latencies=options.timing if options.scenario is not None else None,
        )

    def groups(
        self,
        properties: Sequence[ir.Property] = (),
        *,
        me: str | None = None,
        thorough: bool = False,
        tasks: bool = False,
        single: bool = False,
    ) -> list[Group]:
        """Return the groups of robots, with those by themselves that something tells apart.

        With `single`, each robot is a group. The automata tell apart what `Quotient` says. Raises
        LimitReachedError.
        """
        made = []
        named = self.named(properties)
        for number, automaton in enumerate(self.kinds):
            mask = mask_of(automaton.kind.facts, properties)
            quotient = self._quotient(number, mask, thorough=thorough, tasks=tasks)
            left = list(self._robots[number])
            for robot in self._robots[number]:
                if single or robot in named or robot == me:
                    left.remove(robot)
                    made.append(Group(quotient, (robot,)))
            if left:
                made.append(Group(quotient, tuple(left)))
        return made

    def awaits_members(self, groups: Iterable[Group]) -> bool:
        """Return True if a robot follows events of members that do not come here."""
        casts = [actor for group in groups for actor in group.automaton.whole.kind.cast]
        told = any(actor.listens(JOINED) for actor in casts)
        return not self.guesses and (told if self.environment.faults else self._follows(casts))

    def one_of_each(self, property_: ir.Property) -> list[str | None]:
        """Return robots that stand for each one that a property is about; None for all together."""
        role = property_.each
        if role is None:
            return [None]
        named = self.named([property_])
        found: list[str | None] = []
        for number, automaton in enumerate(self.kinds):
            if automaton.kind.role == role:
                robots = self._robots[number]
                found += [robot for robot in robots if robot in named]
                found += [robot for robot in robots if robot not in named][-1:]
        return found

    def doubts(self, groups: Iterable[Group]) -> list[Doubt]:
        """Return the reasons why proofs about some groups are not complete."""
        numbers = (self.kinds.index(group.automaton.whole) for group in groups)
        return list(dict.fromkeys(doubt for number in numbers for doubt in self._doubts[number]))

    @property
    def every_doubt(self) -> list[Doubt]:
        """The reasons why proofs about all robots are not complete."""
        return list(dict.fromkeys(doubt for found in self._doubts.values() for doubt in found))

    def may_send(self, group: Group) -> set[str]:
        """Return the events that a group may send other robots, beyond those that it was seen to.

        What a robot does is not all known if it has too many states, or there is a doubt.
        """
        automaton = group.automaton.whole
        if automaton in self._unfinished or self._doubts[self.kinds.index(automaton)]:
            names = [actor.machine.name for actor in automaton.kind.cast]
            return {each.event for each in self.sends(names)} | {DEPARTED}
        return set()

    def _quotient(self, number: int, mask: int, *, thorough: bool, tasks: bool) -> Quotient:
        key = (number, mask, thorough, tasks)
        if key not in self._quotients:
            self._budget.check()
            self._quotients[key] = Quotient(
                self.kinds[number], mask, thorough=thorough, tasks=tasks
            )
        return self._quotients[key]

    # ---- what is known before

    def sends(self, names: Iterable[str]) -> Iterator[ir.Send]:
        """Yield the sends of some machines."""
        return sends(self.system.machines_by_name[name] for name in names)

    def _gather(self, facts: FactsByRole) -> None:
        """Make an automaton for each kind of robot."""
        keys: dict[Any, int] = {}
        for robot, cast in self._by_robot.items():
            key = key_of(
                cast, self.machines, self.system, self.demands, self.options, self.environment
            )
            if key in keys:
                self._robots[keys[key]].append(robot)
                self.kinds[keys[key]].kind.robots[robot] = cast
                continue
            keys[key] = len(self.kinds)
            self._robots.append([robot])
            doubts = self._doubts[len(self.kinds)] = list(self._doubtful(cast))
            kind = self._kind(cast, facts[cast[0].robot.role], doubts)
            for message in self._of_strangers(kind, doubts):
                self.alphabet.number(message)
            automaton = Automaton(kind, self.alphabet)
            self.kinds.append(automaton)
            if any(moment.event is not None for moment in automaton.first.moments):
                doubts.append(Doubt("a delay of zero ends while the robots still start"))
            if automaton.asks_at_start:
                doubts.append(Doubt("who is near when the robots start is not covered"))

    def _of_strangers(self, kind: Kind, doubts: list[Doubt]) -> Iterator[Event]:
        """Yield the messages that a robot may get from robots that are left out."""
        sends = list(self.sends(dict.fromkeys(each.machine.name for each in self._strangers)))
        senders = [each.robot for each in self._strangers]
        return messages_to(kind, senders, sends, self.demands, self.environment, doubts)

    def _kind(
        self,
        cast: Sequence[Actor],
        facts: Sequence[ir.Fact | ir.Count],
        doubts: list[Doubt],
    ) -> Kind:
        robot = cast[0].robot
        ends = {
            each.function: self.environment.ends(each.function, robot, doubts)
            for each in activities(cast, self.machines)
        }
        arrivals = self.environment.arrivals(cast, doubts, is_alone=self.subject.swarm is None)
        return Kind(
            robot.role,
            cast,
            facts,
            arrivals,
            ends,
            self._crew if self.environment.faults or self._follows(cast) else None,
            self.environment.faults,
            self.environment.can_be_lost(robot),
            self.environment.absences(robot),
            len(self._crew.robots) - 1,
            {robot.name: cast},
        )

    def _follows(self, cast: Iterable[Actor]) -> bool:
        return any(map(self._crew.observes, cast))

    def _doubtful(self, cast: Sequence[Actor]) -> Iterator[Doubt]:
        """Yield what proofs do not cover of a robot."""
        robot, has_heartbeat = cast[0].robot, self._crew.has_heartbeat
        for actor in cast:
            machine = self.machines[actor.machine.name]
            yield from uncovered(machine, robot, self.options, has_heartbeat=has_heartbeat)
        yield from uncovered_lifespans(self.system, cast)
        yield from self.demands.timed()
        yield from self.environment.doubts(cast)
