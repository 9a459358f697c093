"""Race of candidates on the same seeds: those that are worse than the best leave.

With several objectives, those leave that another candidate dominates for certain.

After each round, a paired t-test compares each candidate with the best so far. Levels are those of
S. Holm, 1979, for the candidates of a round, shared equally by the rounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

from swarmdsl.base.records import dataclass
from swarmdsl.execution.experiments.comparing import Comparison, compare_paired
from swarmdsl.execution.experiments.search.evaluation import Aim, Evaluation, ranked, values_of
from swarmdsl.execution.experiments.search.front import undominated

FIRST = 5
"""Seeds of the first round; later ones double what there is."""

Add = Callable[[Sequence[Evaluation], range], None]
"""Adds the rows of some seeds to candidates."""


@dataclass(frozen=True)
class Round:
    """A round: the candidates that ran in it, and those that left after it."""

    number: int
    ran: tuple[Evaluation, ...]
    left: tuple[Evaluation, ...]
    survivors: tuple[Evaluation, ...]


def rounds_of(first_seed: int, seeds: int) -> list[range]:
    """Return the seeds of each round."""
    ends, size = [0], FIRST
    while ends[-1] < seeds:
        ends.append(min(ends[-1] + size, seeds))
        size = ends[-1]
    return [range(first_seed + begin, first_seed + end) for begin, end in pairwise(ends)]


def race(
    found: Sequence[Evaluation], add: Add, aim: Aim, rounds: Sequence[range], error: float
) -> Iterator[Round]:
    """Run rounds until one candidate is left or the seeds are used up.

    The probability to lose the best one, if there is one, or one of the front is `error` at most.
    """
    running = list(found)
    for number, seeds in enumerate(rounds):
        add(running, seeds)
        possible = ranked(running, aim)
        choose = undominated if aim.others else _survivors
        survivors = choose(possible, aim, error / len(rounds))
        left = tuple(each for each in running if each not in survivors)
        yield Round(number, tuple(running), left, tuple(survivors))
        running = survivors
        if len(running) <= 1:
            return


def _survivors(possible: Sequence[Evaluation], aim: Aim, error: float) -> list[Evaluation]:
    """Return the candidates that are not worse than the first one, which is the best."""
    if len(possible) < 2:
        return list(possible)
    best, *others = possible
    tests = [(_test(each, best, aim, error), each) for each in others]
    tests.sort(key=lambda pair: -_statistic(pair[0]))
    worse = []
    for rank, (_, each) in enumerate(tests):
        # One side: nothing is better than the best.
        found = _test(each, best, aim, 2 * error / (len(tests) - rank))
        if found is None or found.answer != "no":
            break
        worse.append(each)
    return [each for each in possible if each not in worse]


def _test(each: Evaluation, best: Evaluation, aim: Aim, error: float) -> Comparison | None:
    left, right = values_of(each, best)
    return compare_paired(left, right, aim.goal, 1 - error) if left else None


def _statistic(found: Comparison | None) -> float:
    """Return the statistic of the test, without its sign."""
    if found is None or found.difference == 0:
        return 0.0
    if found.deviation == 0:
        return math.inf
    return abs(found.difference) / found.deviation * math.sqrt(found.runs)
