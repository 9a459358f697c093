"""Weaker and stronger properties, held against the verdicts on random runs."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace

import pytest

from swarmdsl.execution.engine import Event
from swarmdsl.execution.monitor import FALSE, Monitor, Sentence
from swarmdsl.execution.simulate.machines.expressions import function_of
from swarmdsl.ir import (
    Binary,
    Claim,
    Count,
    EventData,
    Expression,
    Fact,
    FieldAccess,
    Junction,
    Named,
    Property,
    Robots,
    Scope,
)
from swarmdsl.ir import Literal as Constant
from swarmdsl.ir.architecture import Multiplicity
from swarmdsl.ir.operations import OPERATIONS
from swarmdsl.ir.properties import Chance
from swarmdsl.syntax.types import BOOL, DURATION, INT
from swarmdsl.tools.compare.strength import strength

A, B, C = (Fact("arrives", name) for name in "ABC")
NEVER = Property("One", "Crew", "never", (A,))
NONE = Robots("robot", "no")
ONE = Robots("robot", "number", Multiplicity(1, 1))
LEADS = Property("One", "Crew", "leads", (A, B), within=Constant(5, DURATION))


def both(*claims: Claim) -> Junction:
    return Junction("and", claims)


def chance(bound: str, probability: float) -> Property:
    return replace(LEADS, chance=Chance(bound, probability))  # type: ignore[arg-type]


def compared(operator: str, number: int) -> Binary:
    field = FieldAccess(EventData(Named("m", "C")), "x", INT)
    return Binary(operator, field, Constant(number, INT), BOOL)


def sent(*limits: tuple[str, int], robots: Robots | None = None) -> Property:
    """Return that no `C` is sent whose field `x` is in these limits."""
    guard: Expression | None = None
    for limit in limits:
        guard = compared(*limit) if guard is None else Binary("and", guard, compared(*limit), BOOL)
    return replace(NEVER, claims=(Fact("sends", "C", robots, guard),))


def ended(outcome: str, robots: Robots | None = None) -> Property:
    return replace(NEVER, claims=(Fact("ends", "carry", robots, outcome=outcome),))


def more(number: int) -> Property:
    return replace(NEVER, claims=(Count("robot", "Work", ">", number),))


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        (LEADS, replace(LEADS, within=Constant(9, DURATION)), "weaker"),
        (LEADS, replace(LEADS, within=None), "weaker"),
        (LEADS, chance("least", 0.9), "weaker"),
        (chance("least", 0.9), chance("least", 0.95), "stronger"),
        (chance("most", 0.1), chance("most", 0.05), "stronger"),
        (chance("least", 0.9), chance("most", 0.9), None),
        # The later it may come, the more often it comes: the more is forbidden.
        (chance("most", 0.1), replace(chance("most", 0.1), within=None), "stronger"),
        (more(2), more(3), "weaker"),
        (sent(), sent((">", 3)), "weaker"),
        (sent((">", 3)), sent((">", 5)), "weaker"),
        (sent((">", 3)), sent((">=", 3)), "stronger"),
        (sent((">", 3)), sent(("<", 5)), None),
        (sent((">", 3)), sent((">", 3), ("<", 9)), "weaker"),
        (sent(("<=", 3)), sent(("==", 3)), "weaker"),
        (sent((">", 3), robots=NONE), sent((">", 5), robots=NONE), "stronger"),
        (ended(""), ended("aborted"), "weaker"),
        (ended("", NONE), ended("aborted", NONE), "stronger"),
        (ended("succeeded"), ended("aborted"), None),
        (ended("", ONE), ended("aborted", ONE), None),
        (sent((">", 3), robots=ONE), sent((">", 5), robots=ONE), None),
        (replace(NEVER, claims=(both(A, B),)), NEVER, "stronger"),
        (replace(LEADS, claims=(A, both(B, C))), LEADS, "weaker"),
        (replace(LEADS, claims=(both(A, C), B)), LEADS, "stronger"),
        (replace(LEADS, claims=(A, both(B, C))), replace(LEADS, within=None), "weaker"),
        (LEADS, replace(LEADS, claims=(both(A, C), both(B, C))), None),
        (LEADS, replace(LEADS, kind="then", within=None), None),
        (NEVER, replace(NEVER, subject="Other"), None),
        (NEVER, replace(NEVER, scope=Scope("after", (B,))), "weaker"),
        (NEVER, replace(NEVER, each="robot"), None),
    ],
)
def test_examples(before: Property, after: Property, expected: str | None) -> None:
    opposite = {"weaker": "stronger", "stronger": "weaker", None: None}
    assert strength(before, after) == expected
    assert strength(after, before) == opposite[expected]
    assert strength(before, before) is None


# ---- random versions

KINDS = {"never": 1, "always": 1, "eventually": 1, "leads": 2, "only": 2, "times": 1, "then": 3}
KINDS |= {"again": 1, "possible": 1}
SCOPES = {"after": 1, "before": 1, "between": 2, "until": 2}
Facts = Mapping[str, int]
"""A moment of a run: whether each of some facts holds, or how many robots it holds for; for `C`,
field `x` of its message, or a negative number if it is not sent."""


def random_claim(dice: random.Random, depth: int = 2) -> Claim:
    if dice.random() < 0.2:
        robots = dice.choice((None, Robots("robot", "some"), Robots("robot", "no")))
        return Fact("sends", "C", robots, random_condition(dice))
    if depth and dice.random() < 0.4:
        operator = dice.choice(("and", "or", "not"))
        count = 1 if operator == "not" else 2
        return Junction(operator, tuple(random_claim(dice, depth - 1) for _ in range(count)))
    if dice.random() < 0.3:
        return Count("robot", "N", dice.choice(("<", ">", "<=", ">=", "==")), dice.randrange(3))
    if dice.random() < 0.3:
        low = dice.randrange(3)
        number = Robots("robot", "number", Multiplicity(low, dice.choice((None, low, low + 1))))
        robots = dice.choice((number, Robots("robot", "some"), Robots("robot", "no")))
        return Fact("in", "N", robots)
    return dice.choice((A, B))


def random_condition(dice: random.Random) -> Expression | None:
    """Make a condition on field `x` of a message, which is a small number."""
    if dice.random() < 0.2:
        return None
    found = compared(dice.choice(("<", "<=", ">", ">=", "==", "!=")), dice.randrange(4))
    if dice.random() < 0.3:
        other = compared(dice.choice(("<", ">")), dice.randrange(4))
        found = Binary(dice.choice(("and", "or")), found, other, BOOL)
    return found


def random_change(claim: Claim, dice: random.Random) -> Claim:
    """Change a claim a little, in most cases so that it says more or less."""
    if dice.random() < 0.3:
        return claim
    if isinstance(claim, Junction) and dice.random() < 0.5:
        number = dice.randrange(len(claim.claims))
        if claim.operator != "not" and dice.random() < 0.5:
            return claim.claims[number]
        claims = list(claim.claims)
        claims[number] = random_change(claims[number], dice)
        return replace(claim, claims=tuple(claims))
    if isinstance(claim, Count):
        return replace(claim, number=dice.randrange(3))
    if isinstance(claim, Fact) and claim.act == "sends":
        return replace(claim, guard=random_condition(dice))
    if dice.random() < 0.2:
        return random_claim(dice)
    return Junction(dice.choice(("and", "or")), (claim, random_claim(dice, 1)))


def random_scope(dice: random.Random, base: Scope | None) -> Scope | None:
    if dice.random() < 0.4:
        return None
    kind = dice.choice(list(SCOPES))
    claims = [random_claim(dice, 0) for _ in range(SCOPES[kind])]
    if base is not None:
        claims = [*base.claims, *claims][: SCOPES[kind]]
    return Scope(kind, tuple(claims))  # type: ignore[arg-type]


def random_property(dice: random.Random) -> Property:
    kind = dice.choice(list(KINDS))
    return Property(
        "One",
        "Crew",
        kind,  # type: ignore[arg-type]
        tuple(random_claim(dice) for _ in range(KINDS[kind])),
        scope=random_scope(dice, None),
        within=random_length(dice) if kind in ("eventually", "leads") else None,
        times=dice.randrange(3) if kind == "times" else None,
    )


def random_length(dice: random.Random) -> Constant | None:
    return dice.choice((None, Constant(dice.randrange(6), DURATION)))


def random_version(of: Property, dice: random.Random) -> Property:
    found = of
    if dice.random() < 0.5:
        found = replace(found, claims=tuple(random_change(each, dice) for each in of.claims))
    if of.kind == "then" and dice.random() < 0.5:
        found = replace(found, claims=found.claims[: dice.randrange(1, 4)])
    if dice.random() < 0.4:
        found = replace(found, scope=random_scope(dice, of.scope))
    if of.kind in ("eventually", "leads") and dice.random() < 0.3:
        found = replace(found, within=random_length(dice))
    if of.kind == "times" and dice.random() < 0.5:
        found = replace(found, times=dice.randrange(3))
    return found


def holds(claim: Claim, facts: Facts) -> bool:
    if isinstance(claim, Junction):
        found = [holds(each, facts) for each in claim.claims]
        return {"and": all(found), "or": any(found), "not": not found[0]}[claim.operator]
    if isinstance(claim, Count):
        return bool(OPERATIONS[claim.comparison](facts["N"], claim.number))
    if claim.act == "sends":
        guard = function_of(claim.guard) if claim.guard is not None else None
        is_sent = facts["C"] >= 0 and (
            guard is None or bool(guard({}, Event("C", {"x": facts["C"]})))
        )
        return is_sent != (claim.robots is not None and claim.robots.quantifier == "no")
    if claim.robots is None:
        return bool(facts[claim.name])
    if claim.robots.number is None:
        return (facts["N"] > 0) == (claim.robots.quantifier == "some")
    low, high = claim.robots.number.lower, claim.robots.number.upper
    return low <= facts["N"] and (high is None or facts["N"] <= high)


def is_violated(by: Sequence[tuple[int, Facts]], one: Property, *, ended: bool) -> bool:
    kind, within = one.scope.kind if one.scope is not None else None, one.within
    length = within.value if isinstance(within, Constant) else None
    monitor = Monitor(Sentence(one.kind, kind, length, one.times))  # type: ignore[arg-type]
    scope = one.scope.claims if one.scope is not None else ()
    for time, facts in by:
        claims = [holds(each, facts) for each in one.claims]
        monitor.step(time, claims, [holds(each, facts) for each in scope])
    return monitor.finish(by[-1][0] + 3, ended=ended) == FALSE


def random_moment(dice: random.Random) -> Facts:
    happen = {"A": dice.random() < 0.4, "B": dice.random() < 0.4}
    return {**happen, "C": dice.randrange(-2, 4), "N": dice.randrange(4)}


def test_no_run_contradicts_what_is_said() -> None:
    dice = random.Random(1)
    counts: Counter[str | None] = Counter()
    apart = 0
    for _ in range(4_000):
        one = random_property(dice)
        other = random_version(one, dice)
        said = strength(one, other)
        counts[said] += 1
        if said is None:
            continue
        weak, strong = (other, one) if said == "weaker" else (one, other)
        for _ in range(8):
            times = sorted(dice.randrange(20) for _ in range(dice.randrange(1, 8)))
            run = [(time, random_moment(dice)) for time in times]
            ended = dice.random() < 0.5
            breaks = is_violated(run, strong, ended=ended)
            if is_violated(run, weak, ended=ended):
                assert breaks, (one, other, said, run, ended)
            apart += breaks and not is_violated(run, weak, ended=ended)
    assert min(counts.values()) > 400
    assert apart > 200
