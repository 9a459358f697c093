"""Coverability in swarms of any size: a search backwards from what must not be.

A robot is a token: its state, and messages that are on their way to it. A set of tokens stands for
all swarms that have these robots with these messages, and perhaps more of both. The search finds
the sets from which a wanted one can be reached, the smallest first; of these there are finitely
many that say something new (P. Abdulla, K. Cerans, B. Jonsson and Y. Tsay, 1996; with broadcasts
J. Esparza, A. Finkel and R. Mayr, 1999). Any number of messages can be on their way.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from heapq import heappop, heappush
from itertools import count, product
from typing import NamedTuple

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.verify.automata.limits import Budget

_OFTEN = 256
"""Number of sets of tokens between two looks at the limits."""


class Token(NamedTuple):
    """A robot of a population: its state, and messages that are on their way to it, sorted."""

    population: int
    state: int
    bag: tuple[int, ...] = ()


Tokens = tuple[Token, ...]
"""Robots of a swarm, sorted."""


class Rule(NamedTuple):
    """A step of one robot; it may hear a message, and sends some."""

    source: int
    target: int
    hears: int | None = None
    sends: tuple[int, ...] = ()


@dataclass
class Population:
    """Robots with the same states and steps; `most` is None if there may be any number.

    `says` are the messages that each sends when it starts, `heard` those that a robot can get from
    each population.
    """

    least: int
    most: int | None
    first: int
    says: tuple[int, ...] = ()
    rules: Sequence[Rule] = ()
    heard: Sequence[frozenset[int]] = field(default_factory=tuple)


class Cover(NamedTuple):
    """Answer of a search: the smallest number of robots of each population, None if none will do.

    `looked` is the number of sets of tokens; the search is `complete` if it came to no limit.
    """

    numbers: tuple[int, ...] | None
    looked: int
    complete: bool


def cover(
    swarm: Sequence[Population],
    wanted: Iterable[Tokens],
    budget: Budget,
    known: tuple[int, ...] | None = None,
) -> Cover:
    """Search for the smallest swarm that can get to one of some sets of tokens.

    If a swarm is `known` that will do, look only for smaller ones.
    """
    search = _Search(swarm)
    search.best = known
    for each in wanted:
        search.add(each)
    complete = search.run(budget)
    return Cover(search.best, search.looked, complete)


class _Search:
    def __init__(self, swarm: Sequence[Population]) -> None:
        self.best: tuple[int, ...] | None = None
        self.looked = 0
        self._swarm = swarm
        self._known: dict[tuple[int, int], list[Tokens]] = {}
        """Sets of tokens that were found, by the place of their first token."""
        self._queue: list[tuple[int, int, int, Tokens]] = []
        self._order = count()
        self._into: dict[tuple[int, int], list[Rule]] = {}
        self._senders: dict[int, list[tuple[int, Rule]]] = {}
        for number, rules in enumerate(_usable(swarm)):
            for rule in rules:
                self._into.setdefault((number, rule.target), []).append(rule)
                for message in dict.fromkeys(rule.sends):
                    self._senders.setdefault(message, []).append((number, rule))

    def add(self, tokens: Tokens) -> None:
        """Keep a set of tokens unless a known one has less, or more robots are too many."""
        if not self._is_possible(tokens) or self._is_known(tokens):
            return
        first = tokens[0] if tokens else Token(-1, -1)
        self._known.setdefault(first[:2], []).append(tokens)
        self.looked += 1
        on_the_way = sum(len(token.bag) for token in tokens)
        heappush(self._queue, (len(tokens), on_the_way, next(self._order), tokens))

    def run(self, budget: Budget) -> bool:
        """Search until nothing new is found; return False if that ended at a limit."""
        looks = 0
        while self._queue:
            size, _, _, tokens = heappop(self._queue)
            if self.best is not None and size >= sum(self.best):
                return True
            looks += 1
            is_asked = looks % _OFTEN == 1
            if self.looked > budget.most or (is_asked and not budget.allows(self.looked)):
                return False
            if self._is_outdone(tokens):
                continue
            numbers = self._numbers(tokens)
            if numbers is not None and (self.best is None or sum(numbers) < sum(self.best)):
                self.best = numbers
            if numbers != self._least(tokens):
                for before in self._before(tokens):
                    self.add(before)
        return True

    def _before(self, tokens: Tokens) -> Iterator[Tokens]:
        """Yield the sets of tokens from which one step leads to a set."""
        for at, token in enumerate(tokens):
            if at and tokens[at - 1] == token:
                continue
            rest = (*tokens[:at], *tokens[at + 1 :])
            for rule in self._into.get(token[:2], ()):
                bag = token.bag if rule.hears is None else _with(token.bag, rule.hears)
                others = self._unsaid(rest, rule.sends, token.population)
                yield _sorted(others, Token(token.population, rule.source, bag))
        told: dict[tuple[int, Rule], None] = {}
        for message in dict.fromkeys(m for token in tokens for m in token.bag):
            told.update(dict.fromkeys(self._senders.get(message, ())))
        for number, rule in told:
            others = self._unsaid(tokens, rule.sends, number)
            if others != tokens:
                bag = () if rule.hears is None else (rule.hears,)
                yield _sorted(others, Token(number, rule.source, bag))

    def _unsaid(self, tokens: Tokens, sends: Sequence[int], sender: int) -> Tokens:
        """Return tokens before somebody has sent some messages."""
        if not sends:
            return tokens
        return tuple(self._without(token, sends, sender) for token in tokens)

    def _without(self, token: Token, sends: Sequence[int], sender: int) -> Token:
        if not token.bag:
            return token
        heard = self._swarm[token.population].heard[sender]
        bag = list(token.bag)
        for message in sends:
            if message in heard and message in bag:
                bag.remove(message)
        return token._replace(bag=tuple(bag))

    def _is_possible(self, tokens: Tokens) -> bool:
        """Return True if no population has more robots than there can be."""
        return all(
            population.most is None or _number(tokens, number) <= population.most
            for number, population in enumerate(self._swarm)
        )

    def _is_known(self, tokens: Tokens) -> bool:
        places = {token[:2] for token in tokens} | {(-1, -1)}
        return any(_has(tokens, less) for each in places for less in self._known.get(each, ()))

    def _is_outdone(self, tokens: Tokens) -> bool:
        """Return True if a set with less was found after a set of tokens, and forget this one."""
        alike = self._known[(tokens[0] if tokens else Token(-1, -1))[:2]]
        alike.remove(tokens)
        if self._is_known(tokens):
            return True
        alike.append(tokens)
        return False

    def _numbers(self, tokens: Tokens) -> tuple[int, ...] | None:
        """Return the smallest swarm that starts with some tokens, or None."""
        if any(token.state != self._swarm[token.population].first for token in tokens):
            return None
        least = self._least(tokens)
        need = max((len(token.bag) for token in tokens), default=0)
        # A robot does not hear itself: for a message of its own kind, there is one more.
        more = []
        for number, population in zip(least, self._swarm, strict=True):
            most = number + need + 1 if need and population.says else number
            if population.most is not None:
                most = min(most, population.most)
            more.append(range(number, most + 1))
        for numbers in sorted(product(*more), key=sum):
            if all(self._starts_with(token, numbers) for token in tokens):
                return numbers
        return None

    def _least(self, tokens: Tokens) -> tuple[int, ...]:
        """Return the smallest swarm that has some tokens."""
        return tuple(max(_number(tokens, n), each.least) for n, each in enumerate(self._swarm))

    def _starts_with(self, token: Token, numbers: Sequence[int]) -> bool:
        """Return True if so many robots send a token its messages when they start."""
        population = self._swarm[token.population]
        for message in set(token.bag):
            sent = sum(
                (numbers[n] - (n == token.population)) * each.says.count(message)
                for n, each in enumerate(self._swarm)
                if message in population.heard[n]
            )
            if sent < token.bag.count(message):
                return False
        return True


def _usable(swarm: Sequence[Population]) -> list[list[Rule]]:
    """Return the rules that some robot of a swarm, however large, may take."""
    states: list[set[int]] = [{p.first} if p.most != 0 else set() for p in swarm]
    heard: list[set[int]] = [set() for _ in swarm]

    def say(sends: Iterable[int], sender: int) -> bool:
        told = False
        for number, population in enumerate(swarm):
            new = (set(sends) & population.heard[sender]) - heard[number]
            heard[number] |= new
            told |= bool(new)
        return told

    for number, population in enumerate(swarm):
        if population.most != 0:
            say(population.says, number)
    found: list[list[Rule]] = []
    changed = True
    while changed:
        changed = False
        found = [[] for _ in swarm]
        for number, population in enumerate(swarm):
            for rule in population.rules:
                if rule.source not in states[number]:
                    continue
                if rule.hears is not None and rule.hears not in heard[number]:
                    continue
                found[number].append(rule)
                changed |= rule.target not in states[number]
                states[number].add(rule.target)
                changed |= say(rule.sends, number)
    return found


def _number(tokens: Tokens, population: int) -> int:
    return sum(token.population == population for token in tokens)


def _with(bag: tuple[int, ...], message: int) -> tuple[int, ...]:
    return tuple(sorted((*bag, message)))


def _sorted(tokens: Tokens, token: Token) -> Tokens:
    return tuple(sorted((*tokens, token)))


def _has(tokens: Tokens, less: Tokens) -> bool:
    """Return True if each of some tokens is one of others, with as many messages at least."""
    if len(less) > len(tokens):
        return False
    if not less:
        return True
    first, *others = less
    for at, token in enumerate(tokens):
        if at and tokens[at - 1] == token:
            continue
        if token[:2] == first[:2] and _is_part(first.bag, token.bag):
            rest = (*tokens[:at], *tokens[at + 1 :])
            if _has(rest, tuple(others)):
                return True
    return False


def _is_part(bag: tuple[int, ...], other: tuple[int, ...]) -> bool:
    if not bag:
        return True
    return all(bag.count(message) <= other.count(message) for message in set(bag))
