"""Truth of claims in a run, and for how many robots they hold."""

from __future__ import annotations

import operator
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol

from .claims import Claim, Count, Fact, Junction, facts_in
from .facts import MOMENTARY, Facts

Shared = Callable[[int], Sequence[int]]
"""Bits of those facts of which the number of robots matters."""


class Present(Protocol):
    """Robot with the facts about its machines that have started and are not lost."""

    name: str | None
    there: int


class Roll:
    """Robots for which a fact holds, and those that are there, by the bit of the fact."""

    def __init__(self) -> None:
        self.holding: dict[int, set[str | None]] = defaultdict(set)
        self.there: dict[int, set[str | None]] = defaultdict(set)

    def count(self, name: str | None, gained: Sequence[int], lost: Sequence[int]) -> None:
        """Note for which facts a robot is one of those for which they hold, and for which not."""
        for bit in gained:
            self.holding[bit].add(name)
        for bit in lost:
            self.holding[bit].discard(name)

    def come(self, robot: Present, mask: int, shared: Shared) -> int:
        """Let facts about a robot count; return those for which this is new."""
        new = mask & ~robot.there
        robot.there |= new
        for bit in shared(new):
            self.there[bit].add(robot.name)
        return new

    def leave(self, robot: Present, mask: int, shared: Shared) -> int:
        """Let facts about a robot count no more; return those that did."""
        gone = mask & robot.there
        robot.there ^= gone
        for bit in shared(gone):
            self.there[bit].discard(robot.name)
        return gone


Truth = Callable[[int], bool]
"""Truth of a claim, by the key of the moment."""
Quantified = Callable[[Roll, "str | None"], bool]
"""Truth of a fact about some robots; the name is that of the robot of `each`."""
Number = Callable[[Roll, int], int]
"""Number of robots for which a claim holds, by the key of the moment."""
COMPARISONS: Mapping[str, Callable[[Any, Any], bool]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}


class Claims:
    """Claims of one sentence about a swarm, or about each robot of a role.

    `own` are the bits of facts about the robot of `each`, `shared` those of the others. The key of
    a moment has all that decides on the truth of the claims: the own facts that hold, and behind
    them a bit for each of the `quantified` ones.
    """

    def __init__(self, each: str | None, facts: Facts) -> None:
        self.own = self.shared = 0
        self.quantified: list[Quantified] = []
        self._each = each
        self._facts = facts

    @property
    def mask(self) -> int:
        """All facts that the claims are about."""
        return self.own | self.shared

    def key(self, bits: int, roll: Roll, me: str | None) -> int:
        """Return the key of a moment, in which these facts hold for the robot of `each`."""
        found = bits & self.own
        for holds in self.quantified:
            found = found << 1 | holds(roll, me)
        return found

    def number(self, claim: Claim) -> Number:
        """Return for how many robots a claim holds; 0 or 1 if it is not about every one."""
        robots = claim.robots if isinstance(claim, Fact) else None
        if isinstance(claim, Fact) and robots is not None and robots.quantifier == "every":
            bit = self._bit(claim, shared=True)
            return lambda roll, key: len(roll.holding[bit])
        truth = self.truth(claim)
        return lambda roll, key: int(truth(key))

    def truth(self, claim: Claim) -> Truth:
        """Return the truth of a claim."""
        if isinstance(claim, Junction):
            parts = [self.truth(each) for each in claim.claims]
            if claim.operator == "not":
                (part,) = parts
                return lambda key: not part(key)
            together = all if claim.operator == "and" else any
            return lambda key: together(part(key) for part in parts)
        own = isinstance(claim, Fact) and claim.robots is None and claim.act != "arrives"
        own = own and self._each is not None
        bit, quantified = self._bit(claim, shared=not own), self.quantified
        if own:
            return lambda key: bool(key >> len(quantified) & bit)
        quantified.append(_of_robots(claim, bit))
        place = len(quantified)
        return lambda key: bool(key >> (len(quantified) - place) & 1)

    def _bit(self, fact: Fact | Count, *, shared: bool) -> int:
        bit = self._facts.bit(fact, self._role(fact))
        if shared:
            self.shared |= bit
        else:
            self.own |= bit
        return bit

    def _role(self, fact: Fact | Count) -> str | None:
        """Return the role whose robots a fact is about, None for all."""
        if isinstance(fact, Count):
            return fact.role
        if fact.act == "arrives":
            return None
        return fact.robots.role if fact.robots is not None else self._each


def is_momentary(claim: Claim) -> bool:
    """Return True if a claim is about what happens, not only about what is."""
    acts = {each.act for each in facts_in(claim) if isinstance(each, Fact)}
    return not acts.isdisjoint(MOMENTARY)


def _of_robots(fact: Fact | Count, bit: int) -> Quantified:
    if isinstance(fact, Count):
        compare, number = COMPARISONS[fact.comparison], fact.number
        return lambda roll, me: compare(len(roll.holding[bit]), number)
    robots = fact.robots
    if robots is None:
        return lambda roll, me: bool(roll.holding[bit])
    if robots.quantifier == "index":
        name = f"{robots.role}[{robots.number}]"
        return lambda roll, me: name in roll.holding[bit]
    if robots.quantifier == "number":
        least, most = robots.least, robots.most
        return lambda roll, me: (
            least <= len(roll.holding[bit]) and (most is None or len(roll.holding[bit]) <= most)
        )
    if robots.other:
        return _of_others(robots.quantifier, bit)
    if robots.quantifier == "some":
        return lambda roll, me: bool(roll.holding[bit])
    if robots.quantifier == "no":
        return lambda roll, me: not roll.holding[bit]
    return lambda roll, me: len(roll.holding[bit]) == len(roll.there[bit])


def _of_others(quantifier: str, bit: int) -> Quantified:
    def count(robots: set[str | None], me: str | None) -> int:
        return len(robots) - (me in robots)

    if quantifier == "some":
        return lambda roll, me: count(roll.holding[bit], me) > 0
    if quantifier == "no":
        return lambda roll, me: count(roll.holding[bit], me) == 0
    return lambda roll, me: count(roll.holding[bit], me) == count(roll.there[bit], me)
