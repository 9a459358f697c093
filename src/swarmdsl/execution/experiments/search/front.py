"""Front of several objectives, from runs with the same seeds: what the noise lets one say.

A candidate dominates another one for certain if it is better in a paired one-sided test of each
objective. No objective needs a stricter level for that: all of them must agree.
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.execution.experiments.comparing import Answer, compare_paired
from swarmdsl.execution.experiments.search.domination import fronts
from swarmdsl.execution.experiments.search.evaluation import Aim, Evaluation

_SAME = 10
"""Runs from which on values that are all equal count as no difference."""


def relation(a: Evaluation, b: Evaluation, aim: Aim, error: float) -> list[Answer | None]:
    """Return if A is better than B in each objective; None if it is the same in all runs."""
    found: list[Answer | None] = []
    common = sorted(a.by_seed.keys() & b.by_seed.keys())
    for number, objective in enumerate(aim.objectives):
        left = [a.by_seed[seed][number] for seed in common]
        right = [b.by_seed[seed][number] for seed in common]
        if left == right:
            found.append(None if len(common) >= _SAME else "not yet")
        else:
            found.append(compare_paired(left, right, objective.goal, 1 - 2 * error).answer)
    return found


def is_dominated(b: Evaluation, by: Evaluation, aim: Aim, error: float) -> bool:
    """Return True if it is certain that a candidate is dominated."""
    answers = relation(by, b, aim, error)
    return any(answers) and all(each in ("yes", None) for each in answers)


def undominated(possible: Sequence[Evaluation], aim: Aim, error: float) -> list[Evaluation]:
    """Return the candidates that are not dominated for certain.

    The probability to lose one of the front is `error` at most: levels are those of Bonferroni,
    for all pairs.
    """
    if len(possible) < 2:
        return list(possible)
    each_error = error / (len(possible) * (len(possible) - 1))
    losses = [aim.losses(each) for each in possible]
    first = [possible[number] for number in fronts(losses)[0]]
    return [
        each
        for each in possible
        if not any(
            is_dominated(each, other, aim, each_error) for other in first if other is not each
        )
    ]


def is_certain(each: Evaluation, others: Sequence[Evaluation], aim: Aim, error: float) -> bool:
    """Return True if no other one can dominate it: it is better than each of them in something."""
    rest = [other for other in others if other is not each]
    level = error / max(len(rest) * len(aim.objectives), 1)
    return all("yes" in relation(each, other, aim, level) for other in rest)


def beside(each: Evaluation, today: Evaluation, aim: Aim, error: float) -> Answer:
    """Return if a candidate dominates the model as it is.

    It does not if it is worse in something, or the same in all runs.
    """
    answers = relation(each, today, aim, error)
    if "no" in answers or not any(answers):
        return "no"
    return "yes" if all(answer in ("yes", None) for answer in answers) else "not yet"
