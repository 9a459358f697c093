"""Facts of a property in a swarm of groups, and the truth of its claims."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import combinations
from typing import Literal

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.execution.verify.swarm.groups import Local
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.ir import Claim, Count, Fact, Junction
from swarmdsl.ir.sentences import facts_in

Whose = Literal["all", "others", "me"]


@dataclass(frozen=True)
class Number:
    """Claim that a fact holds for some number of robots: of all, of the others, or for me."""

    term: int
    whose: Whose
    least: int
    most: int | None = None


@dataclass(frozen=True)
class Combined:
    """Claims joined by `and` or `or`, or one that is negated by `not`."""

    operator: str
    parts: tuple[Reading, ...]


Reading = Number | Combined
Truth = Callable[[Sequence[int], Sequence[int]], bool]
"""Truth of a claim, given for each fact how many robots it holds for, and if it does for me."""


def is_act(fact: Fact | Count) -> bool:
    """Return True for what happens, in contrast to what is."""
    return isinstance(fact, Fact) and fact.act not in ("in", "has")


def at_start(automaton: Local) -> int:
    """Return the facts of a robot when all robots have started: that is one moment."""
    acts = sum(1 << n for n, each in enumerate(automaton.whole.kind.facts) if is_act(each))
    found = automaton.look(automaton.first.target).holding
    for moment in automaton.first.moments:
        found |= moment.holding & acts
    return found


def is_of_one(property_: ir.Property) -> bool:
    """Return True if a property is about one robot, and about what arrives from outside."""
    return all(isinstance(each, Fact) and each.robots is None for each in facts_of(property_))


class Terms:
    """Facts of a property, each with the groups that it can hold for."""

    def __init__(self, property_: ir.Property, network: Network) -> None:
        self._property = property_
        self._network = network
        self._keys: list[tuple[Fact | Count, str | None, str | None, bool]] = []
        self._bits: list[list[int]] = []
        """For each term, the bit of its fact in each group; 0 where it cannot hold."""

    def __len__(self) -> int:
        return len(self._keys)

    @property
    def facts(self) -> list[Fact | Count]:
        """The facts, in the order of their numbers."""
        return [fact for fact, _, _, _ in self._keys]

    def holds(self, term: int, group: int, bits: int) -> int:
        """Return 1 if a fact holds for a robot with these facts, else 0."""
        return 1 if bits & self._bits[term][group] else 0

    def truth(self, claim: Claim) -> Truth:
        """Compile a claim."""
        return _compiled(self.reading(claim))

    def reading(self, claim: Claim) -> Reading:
        """Return a claim as conditions on numbers of robots."""
        if isinstance(claim, Junction):
            return Combined(claim.operator, tuple(map(self.reading, claim.claims)))
        if isinstance(claim, Count):
            return _compared(self.term(claim, claim.role, None), claim)
        robots = claim.robots
        if robots is None:
            each = self._property.each
            if each is not None and claim.act != "arrives":
                return Number(self.term(claim, each, None), "me", 1)
            return Number(self.term(claim, None, None), "all", 1)
        return self._of_robots(claim, robots)

    def _of_robots(self, claim: Fact, robots: ir.Robots) -> Reading:
        if robots.quantifier == "index":
            term = self.term(claim, robots.role, f"{robots.role}[{robots.index or 0}]")
            return Number(term, "all", 1)
        term = self.term(claim, robots.role, None)
        whose: Whose = "others" if robots.other else "all"
        if robots.quantifier == "number":
            assert robots.number is not None
            return Number(term, "all", robots.number.lower, robots.number.upper)
        if robots.quantifier == "some":
            return Number(term, whose, 1)
        if robots.quantifier == "no":
            return Number(term, whose, 0, 0)
        # Lost robots do not count, so that they may be among those for which it holds.
        term = self.term(claim, robots.role, None, or_lost=True)
        size = sum(len(g.robots) for g in self._network.groups if g.role == robots.role)
        size -= robots.other and self._property.each == robots.role
        return Number(term, whose, size, size)

    def term(
        self, fact: Fact | Count, role: str | None, robot: str | None, *, or_lost: bool = False
    ) -> int:
        """Return the number of a fact, about robots of a role or one robot if they are given.

        With `or_lost`, it is said of lost robots, too.
        """
        or_lost = or_lost and self._network.faults > 0
        key = (fact, role, robot, or_lost)
        if key not in self._keys:
            self._keys.append(key)
            bits = []
            for group in self._network.groups:
                facts = group.automaton.whole.kind.facts
                meant = (role in (None, group.role)) and (robot is None or robot in group.robots)
                same = (n for n, each in enumerate(facts) if same_fact(each, fact))
                bit = 1 << next(same, -1) if meant and _has(facts, fact) else 0
                gone = group.automaton.whole.gone if meant and or_lost else 0
                bits.append(bit | gone)
            self._bits.append(bits)
        return self._keys.index(key)


def _compared(term: int, count: Count) -> Reading:
    number = count.number
    match count.comparison:
        case "==":
            return Number(term, "all", number, number)
        case "!=":
            return Combined("not", (Number(term, "all", number, number),))
        case "<":
            return Number(term, "all", 0, number - 1)
        case "<=":
            return Number(term, "all", 0, number)
        case ">":
            return Number(term, "all", number + 1)
        case ">=":
            return Number(term, "all", number)


def _compiled(reading: Reading) -> Truth:
    if isinstance(reading, Combined):
        parts = [_compiled(each) for each in reading.parts]
        if reading.operator == "not":
            (part,) = parts
            return lambda counts, mine: not part(counts, mine)
        together = all if reading.operator == "and" else any
        return lambda counts, mine: together(part(counts, mine) for part in parts)
    term, least, most = reading.term, reading.least, reading.most
    if reading.whose == "me":
        return lambda counts, mine: mine[term] >= least
    if reading.whose == "others":
        if most is None:
            return lambda counts, mine: counts[term] - mine[term] >= least
        return lambda counts, mine: least <= counts[term] - mine[term] <= most
    if most is None:
        return lambda counts, mine: counts[term] >= least
    return lambda counts, mine: least <= counts[term] <= most


def _has(facts: Sequence[Fact | Count], fact: Fact | Count) -> bool:
    return any(same_fact(each, fact) for each in facts)


def arriving(facts: Sequence[Fact | Count]) -> Iterator[frozenset[int]]:
    """Yield the facts that can hold when another robot acts: none, or those about one event.

    Whether a condition on its message holds is not known.
    """
    yield frozenset()
    events: dict[str, dict[int, bool]] = {}
    for number, fact in enumerate(facts):
        if isinstance(fact, Fact) and fact.act == "arrives":
            events.setdefault(fact.name, {})[number] = fact.guard is None
    for numbers in events.values():
        sure = {number for number, holds in numbers.items() if holds}
        perhaps = [number for number, holds in numbers.items() if not holds]
        for count in range(len(perhaps) + 1):
            yield from (frozenset((*sure, *each)) for each in combinations(perhaps, count))


def same_fact(one: Fact | Count, other: Fact | Count) -> bool:
    """Return True if two facts are about the same, of whichever robots."""
    return meaning(one) == meaning(other)


def meaning(fact: Fact | Count) -> tuple[str, str, ir.Expression | None, str]:
    """Return what a fact says, without the robots that it says it of."""
    if isinstance(fact, Count):
        return ("in", fact.state, None, "")
    return (fact.act, fact.name, fact.guard, fact.outcome)


def facts_of(property_: ir.Property) -> list[Fact | Count]:
    """Return the facts of a property and its scope."""
    scope = property_.scope.claims if property_.scope is not None else ()
    return [fact for claim in (*property_.claims, *scope) for fact in facts_in(claim)]


def roles_of(fact: Fact | Count, property_: ir.Property) -> list[str]:
    """Return the roles whose robots a fact is about; none means all robots."""
    if isinstance(fact, Count):
        return [fact.role]
    if fact.act == "arrives":
        return []
    if fact.robots is not None:
        return [fact.robots.role]
    return [property_.each] if property_.each is not None else []


def mask_of(facts: Sequence[Fact | Count], properties: Iterable[ir.Property]) -> int:
    """Return the bits of the facts that some properties are about."""
    wanted = {meaning(fact) for each in properties for fact in facts_of(each)}
    return sum(1 << n for n, fact in enumerate(facts) if meaning(fact) in wanted)
