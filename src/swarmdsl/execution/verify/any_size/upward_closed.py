"""Claims that more robots never make false, as the least sets of robots that make them true.

Such a claim, as "more than one drone is in `Land`", can be looked for in swarms of any size.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product
from typing import NamedTuple

from swarmdsl.execution.verify.any_size.coverability import Population, Token, Tokens
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import Terms, is_act
from swarmdsl.ir import Claim, Count, Fact, Junction, Property, Robots

_MOST, _MOST_ROBOTS = 64, 100
"""Maximum numbers of alternatives of a claim, and of robots that it asks for."""
_NEGATED = {"<": ">=", ">=": "<", ">": "<=", "<=": ">", "==": "!=", "!=": "=="}
_Number = tuple[int, int | None]
"""Least and greatest number of robots; None is any number."""


class NotCoveredError(Exception):
    """A claim that more robots can make false; the text says why."""


class Need(NamedTuple):
    """So many robots at least, of some groups, for which a fact holds or not."""

    term: int
    holds: bool
    least: int
    groups: frozenset[int]


class Wanted:
    """A claim as alternatives, each with all its needs.

    `me` is the group of the robot of `each`. Raise NotCoveredError if more robots can make the
    claim false.
    """

    def __init__(
        self,
        property_: Property,
        claim: Claim,
        network: Network,
        swarm: Sequence[Population],
        me: int | None,
        *,
        holds: bool = True,
    ) -> None:
        self._each = property_.each
        self._swarm = swarm
        self._me = me
        self._groups = network.groups
        self._terms = Terms(property_, network)
        self.alternatives = [
            tuple(dict.fromkeys(needs)) for needs in self._needs(claim, holds=holds)
        ]

    def met(self, needs: Sequence[Need], group: int, bits: int) -> tuple[bool, ...]:
        """Return for each need if a robot of a group with some facts is one of its robots."""
        return tuple(
            group in need.groups and bool(self._terms.holds(need.term, group, bits)) == need.holds
            for need in needs
        )

    def sets(
        self,
        needs: Sequence[Need],
        places: Sequence[tuple[int, int, int]],
        given: tuple[Token, tuple[bool, ...]] | None = None,
    ) -> set[Tokens]:
        """Return the least sets of robots that meet all needs.

        `places` are the groups and states of robots with the facts that hold there. One robot may
        be `given`, with the needs that it meets.
        """
        useful = [
            (Token(group, state), met)
            for group, state, bits in places
            if any(met := self.met(needs, group, bits))
        ]
        left = [need.least for need in needs]
        tokens: Tokens = ()
        if given is not None:
            tokens = (given[0],)
            left = [number - met for number, met in zip(left, given[1], strict=True)]
        found: set[Tokens] = set()
        self._fill(tokens, left, useful, found, set())
        return found

    def holds(self, present: Sequence[tuple[int, int, int]]) -> bool:
        """Return True if the claim holds of numbers of robots of groups with some facts."""
        return any(
            all(
                sum(number for group, bits, number in present if self.met([need], group, bits)[0])
                >= need.least
                for need in needs
            )
            for needs in self.alternatives
        )

    def _fill(
        self,
        tokens: Tokens,
        left: Sequence[int],
        useful: Sequence[tuple[Token, tuple[bool, ...]]],
        found: set[Tokens],
        seen: set[Tokens],
    ) -> None:
        if tokens in seen:
            return
        seen.add(tokens)
        wanting = next((n for n, number in enumerate(left) if number > 0), None)
        if wanting is None:
            found.add(tokens)
            return
        for token, met in useful:
            if not met[wanting]:
                continue
            most = self._swarm[token.population].most
            if most is not None and sum(t.population == token.population for t in tokens) >= most:
                continue
            rest = [number - is_met for number, is_met in zip(left, met, strict=True)]
            self._fill(tuple(sorted((*tokens, token))), rest, useful, found, seen)

    # ---- claims

    def _needs(self, claim: Claim, *, holds: bool) -> list[tuple[Need, ...]]:
        """Return the alternatives of a claim or of its opposite."""
        if isinstance(claim, Junction):
            if claim.operator == "not":
                return self._needs(claim.claims[0], holds=not holds)
            parts = [self._needs(each, holds=holds) for each in claim.claims]
            if (claim.operator == "or") == holds:
                found = [each for part in parts for each in part]
            else:
                found = [tuple(n for part in each for n in part) for each in product(*parts)]
            if len(found) > _MOST:
                raise NotCoveredError(f"it has more than {_MOST} alternatives")
            return found
        return list(self._of_fact(claim, holds=holds))

    def _of_fact(self, claim: Fact | Count, *, holds: bool) -> Iterator[tuple[Need, ...]]:
        role, robot, groups, numbers, inverse = self._meaning(claim, holds=holds)
        # Of all robots, lost ones do not count.
        term = self._terms.term(claim, role, robot, or_lost=inverse)
        for least, most in numbers:
            needs = [Need(term, not inverse, least, groups)] if least else []
            if most is not None:
                needs.append(self._at_most(claim, term, most, groups, inverse=inverse))
            for need in needs:
                if not need.holds and is_act(claim):
                    raise NotCoveredError("it is about what does not happen")
                if need.least > _MOST_ROBOTS:
                    raise NotCoveredError(f"it is about more than {_MOST_ROBOTS} robots")
            yield tuple(needs)

    def _at_most(
        self, claim: Fact | Count, term: int, most: int, groups: frozenset[int], *, inverse: bool
    ) -> Need:
        """Return the need of the others: all but so many are otherwise."""
        size = 0
        for number in groups:
            population = self._swarm[number]
            if population.most != population.least:
                role = claim.role if isinstance(claim, Count) else self._groups[number].role
                raise NotCoveredError(f"more of `{role}` can end what it is about")
            size += population.least
        return Need(term, inverse, max(size - most, 0), groups)

    def _meaning(
        self, claim: Fact | Count, *, holds: bool
    ) -> tuple[str | None, str | None, frozenset[int], list[_Number], bool]:
        """Return role, robot, groups and numbers of a fact; True if of robots without it."""
        if isinstance(claim, Count):
            sign = claim.comparison if holds else _NEGATED[claim.comparison]
            return claim.role, None, self._of(claim.role), _compared(sign, claim.number), False
        some: list[_Number] = [(1, None)] if holds else [(0, 0)]
        none: list[_Number] = [(0, 0)] if holds else [(1, None)]
        robots = claim.robots
        if robots is None:
            if self._each is not None and claim.act != "arrives":
                me = frozenset() if self._me is None else frozenset({self._me})
                return self._each, None, me, some, False
            return None, None, frozenset(range(len(self._swarm))), some, False
        groups = self._of(robots.role)
        if robots.other and robots.quantifier != "number" and self._me is not None:
            groups -= {self._me}
        match robots.quantifier:
            case "index":
                name = f"{robots.role}[{robots.index or 0}]"
                mine = frozenset(n for n in groups if name in self._groups[n].robots)
                return robots.role, name, mine, some, False
            case "number":
                return robots.role, None, groups, _within(robots, holds=holds), False
            case "no":
                return robots.role, None, groups, none, False
            case "all":
                return robots.role, None, groups, none, True
        return robots.role, None, groups, some, False

    def _of(self, role: str) -> frozenset[int]:
        return frozenset(n for n, group in enumerate(self._groups) if group.role == role)


def _compared(sign: str, number: int) -> list[_Number]:
    """Return the numbers that compare so, as ranges."""
    below: list[_Number] = [(0, number - 1)] if number > 0 else []
    match sign:
        case ">":
            return [(number + 1, None)]
        case ">=":
            return [(number, None)]
        case "<":
            return below
        case "<=":
            return [(0, number)]
        case "==":
            return [(number, number)]
    return [*below, (number + 1, None)]


def _within(robots: Robots, *, holds: bool) -> list[_Number]:
    assert robots.number is not None
    least, most = robots.number.lower, robots.number.upper
    if holds:
        return [(least, most)]
    below: list[_Number] = [(0, least - 1)] if least > 0 else []
    return below if most is None else [*below, (most + 1, None)]
