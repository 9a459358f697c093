"""Front of several objectives, from runs with the same seeds: what the noise lets one say.

A candidate dominates another one for certain if it is better in a paired one-sided test of each
objective. No objective needs a stricter level for that: all of them must agree.
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.execution.experiments.comparing import Answer, compare_paired
from swarmdsl.execution.experiments.search.domination import fronts
from swarmdsl.execution.experiments.search.evaluation import Aim, Evaluation

_SETTLED = 10
"""Runs of each candidate from which on an objective can be known not to depend on chance."""


def settled(found: Sequence[Evaluation], aim: Aim) -> tuple[bool, ...]:
    """Return which objectives do not depend on chance, such as the number of robots.

    No candidate has two values of them. A property never is one of them: it may be violated in
    the next run.
    """
    enough = all(len(each.by_seed) >= _SETTLED for each in found)
    return tuple(
        enough
        and not objective.is_property
        and all(len(set(each.of_objective(number).values())) == 1 for each in found)
        for number, objective in enumerate(aim.objectives)
    )


def relation(
    a: Evaluation, b: Evaluation, aim: Aim, error: float, known: Sequence[bool]
) -> list[Answer | None]:
    """Return if A is better than B in each objective; None if it is the same for certain.

    `known` has the objectives without chance. Where chance is, equal values do not show that there
    is no difference.
    """
    found: list[Answer | None] = []
    common = sorted(a.by_seed.keys() & b.by_seed.keys())
    for number, objective in enumerate(aim.objectives):
        left = [a.by_seed[seed][number] for seed in common]
        right = [b.by_seed[seed][number] for seed in common]
        if known[number]:
            losses = objective.loss(left[0]), objective.loss(right[0])
            found.append(None if left == right else "yes" if losses[0] < losses[1] else "no")
        else:
            found.append(compare_paired(left, right, objective.goal, 1 - 2 * error).answer)
    return found


def _all_better(answers: Sequence[Answer | None]) -> bool:
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
    known = settled(possible, aim)

    def is_worse(each: Evaluation) -> bool:
        others = (other for other in first if other is not each)
        return any(_all_better(relation(other, each, aim, each_error, known)) for other in others)

    return [each for each in possible if not is_worse(each)]


def is_certain(each: Evaluation, others: Sequence[Evaluation], aim: Aim, error: float) -> bool:
    """Return True if no other one can dominate it: it is better than each of them in something."""
    rest = [other for other in others if other is not each]
    level = error / max(len(rest) * len(aim.objectives), 1)
    known = settled([each, *rest], aim)
    return all("yes" in relation(each, other, aim, level, known) for other in rest)


def beside(each: Evaluation, today: Evaluation, aim: Aim, error: float) -> Answer:
    """Return if a candidate dominates the model as it is.

    It does not if it is worse in something, or the same in all runs. Both answers are wrong with a
    probability of `error` at most.
    """
    if each.by_seed == today.by_seed:
        return "no"
    known = settled([each, today], aim)
    # To be worse in one of them is enough: each has its share of the error.
    if "no" in relation(each, today, aim, error / len(aim.objectives), known):
        return "no"
    return "yes" if _all_better(relation(each, today, aim, error, known)) else "not yet"
