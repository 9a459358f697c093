"""Interval of the winner: it holds the true mean, although the winner is the best of many."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from random import Random
from typing import Any

from swarmdsl.execution.experiments.search.evaluation import Aim
from swarmdsl.execution.experiments.search.methods import Name
from swarmdsl.execution.experiments.search.optimizing import Found, Plan, Search
from swarmdsl.execution.experiments.search.space import Dimension, SearchSpace
from swarmdsl.execution.experiments.task import Candidate, Row, Task

SPACE = SearchSpace((Dimension("x", "whole", Fraction(0), Fraction(19), Fraction(1)),))


METHODS: tuple[Name, ...] = ("auto", "random")


def truth(candidate: Candidate) -> float:
    """Return the mean fitness: 0.5 for most, and a little more around 12."""
    x = candidate.values.get("x", 0)
    return 0.5 - 0.002 * min(abs(x - 12), 5)


class Chain:
    """Runs whose fitness is the share of successes of ten tries, with a known mean."""

    def __init__(self, salt: int) -> None:
        self.salt = salt

    def run(self, tasks: Sequence[Task]) -> list[list[Row]]:
        return [[self.row(task.candidate, seed) for seed in task.seeds] for task in tasks]

    def row(self, candidate: Candidate, seed: int) -> Row:
        chance = Random(f"{self.salt} {seed} {candidate.text}")
        good = sum(chance.random() < truth(candidate) for _ in range(10))
        return Row(candidate, "", seed, {}, good / 10)


def searched(salt: int, method: Name) -> Found:
    runs: Any = Chain(salt)
    plan = Plan(SPACE, Aim("maximize"), ("",), method, 20, 20, 30, salt)
    return Search(plan, runs, "", lambda _line: None).run()


def test_the_interval_of_the_winner_holds_the_truth() -> None:
    """In 1,000 searches it is 94.5 % of them: 93 % is what 200 may show."""
    held = optimistic = 0
    for method in METHODS:
        for salt in range(100):
            found = searched(salt, method)
            sample = found.sample(found.winner, 0.95)
            assert sample is not None
            assert sample.interval is not None
            true = truth(found.winner.candidate)
            held += sample.interval.lower <= true <= sample.interval.upper
            race = found.finals[0]
            assert race.candidate == found.winner.candidate
            optimistic += (race.mean or 0) > true

    assert held >= 186
    # What the race says of its winner is too good, which is why there are fresh seeds.
    assert optimistic >= 160
