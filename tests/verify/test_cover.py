"""Backward searches find what swarms of every size can get to, as forward searches do."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from random import Random

import pytest

from swarmdsl.execution.verify.any_size.coverability import (
    Cover,
    Population,
    Rule,
    Token,
    Tokens,
    cover,
)
from swarmdsl.execution.verify.automata.limits import Budget, Limits

STATES, MESSAGES = 3, 2
MOST_ROBOTS = 3
MOST_ON_THE_WAY = 2
"""Number of messages on their way to a robot, up to which the forward search keeps them."""


def random_swarm(chance: Random) -> list[Population]:
    """Return one or two populations: any number of robots, and perhaps one more."""
    numbers: list[tuple[int, int | None]] = [(chance.choice((0, 1)), chance.choice((None, 2)))]
    if chance.random() < 0.5:
        numbers.append((1, 1))
    swarm = []
    for number, (least, most) in enumerate(numbers):
        rules = []
        for _ in range(chance.randint(3, 6)):
            hears = chance.choice((None, None, *range(MESSAGES)))
            sends = [chance.randrange(MESSAGES)] if chance.random() < 0.4 else []
            source, target = chance.randrange(STATES), chance.randrange(STATES)
            rules.append(Rule(source, target, hears, tuple(sends)))
        heard = [
            # One robot alone does not hear itself.
            frozenset[int]() if other == number and most == 1 else frozenset(range(MESSAGES))
            for other in range(len(numbers))
        ]
        says = (0,) if chance.random() < 0.2 else ()
        swarm.append(Population(least, most, 0, says, rules, heard))
    return swarm


def random_tokens(chance: Random, swarm: Sequence[Population]) -> Tokens:
    """Return one to three robots to look for."""
    found = []
    for _ in range(chance.randint(1, 3)):
        found.append(Token(chance.randrange(len(swarm)), chance.randrange(STATES)))
    return tuple(sorted(found))


def reaches(swarm: Sequence[Population], numbers: Sequence[int], wanted: Tokens) -> bool:
    """Search forward among so many robots; messages beyond a number are lost."""
    senders = [(n, m) for n, p in enumerate(swarm) for _ in range(numbers[n]) for m in p.says]
    start = []
    for number, population in enumerate(swarm):
        bag = [m for n, m in senders if m in population.heard[n]]
        if numbers[number]:
            for message in population.says:
                if message in population.heard[number]:
                    bag.remove(message)
        bag = bag[:MOST_ON_THE_WAY]
        start += [Token(number, population.first, tuple(sorted(bag)))] * numbers[number]
    seen = {tuple(sorted(start))}
    todo = list(seen)
    need = Counter((token.population, token.state) for token in wanted)
    while todo:
        tokens = todo.pop()
        if need <= Counter((token.population, token.state) for token in tokens):
            return True
        for after in following(swarm, tokens):
            if after not in seen:
                seen.add(after)
                todo.append(after)
    return False


def following(swarm: Sequence[Population], tokens: Tokens) -> Iterator[Tokens]:
    """Yield the swarms after one step of a robot."""
    for at, token in enumerate(tokens):
        others = (*tokens[:at], *tokens[at + 1 :])
        for rule in swarm[token.population].rules:
            bag = list(token.bag)
            if rule.source != token.state or (rule.hears is not None and rule.hears not in bag):
                continue
            if rule.hears is not None:
                bag.remove(rule.hears)
            after = [told(swarm, each, rule.sends, token.population) for each in others]
            after.append(Token(token.population, rule.target, tuple(bag)))
            yield tuple(sorted(after))


def told(swarm: Sequence[Population], token: Token, sends: Sequence[int], sender: int) -> Token:
    """Return a robot after another one has sent some messages."""
    heard = [m for m in sends if m in swarm[token.population].heard[sender]]
    bag = (*token.bag, *heard[: MOST_ON_THE_WAY - len(token.bag)])
    return token._replace(bag=tuple(sorted(bag)))


def searched(swarm: Sequence[Population], wanted: Tokens, states: int = 20_000) -> Cover:
    """Search backwards."""
    return cover(swarm, [wanted], Budget(Limits(states=states)))


def test_smallest_swarms_are_those_of_forward_searches() -> None:
    found: Counter[int | None] = Counter()
    for seed in (*range(100), 2789):
        chance = Random(seed)
        swarm = random_swarm(chance)
        wanted = random_tokens(chance, swarm)
        answer = searched(swarm, wanted)
        assert answer.complete
        most = swarm[0].most or MOST_ROBOTS
        sizes = [
            (n, *(1 for _ in swarm[1:])) for n in range(swarm[0].least, min(most, MOST_ROBOTS) + 1)
        ]
        smallest = next((size for size in sizes if reaches(swarm, size, wanted)), None)

        # What takes more messages or robots than the forward search has is not compared.
        if smallest is not None or answer.numbers is None:
            assert answer.numbers == smallest, seed
            found[sum(smallest) if smallest is not None else None] += 1

    assert found.total() > 95
    assert min(found[None], found[1], found[2], found[3]) > 2


def test_a_search_ends_at_its_limit() -> None:
    rules = [Rule(0, 1, None, (0,)), Rule(1, 2, 0), Rule(2, 3, 0), Rule(3, 4, 0)]
    swarm = [Population(1, None, 0, (), rules, [frozenset({0})])]
    wanted = (Token(0, 4), Token(0, 4))

    assert searched(swarm, wanted) == Cover((4,), searched(swarm, wanted).looked, complete=True)
    assert not searched(swarm, wanted, states=1).complete


@pytest.mark.parametrize("most", [None, 3])
def test_no_more_robots_than_there_can_be(most: int | None) -> None:
    # Each robot that is needed has to stay where it was.
    swarm = [Population(0, most, 0, (), [Rule(0, 1)], [frozenset()])]
    wanted = tuple(Token(0, state) for state in (0, 0, 1, 1))

    assert searched(swarm, wanted).numbers == ((4,) if most is None else None)
