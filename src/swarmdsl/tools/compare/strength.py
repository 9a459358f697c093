"""Find out which of two versions of a property is the weaker one, where that is certain.

A property is weaker than another one if each run that the other one allows is allowed by it too.
Names mean the same in both versions.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf
from typing import Literal

from swarmdsl.ir import Binary, Claim, Count, Expression, Fact, Junction, Property, Robots
from swarmdsl.ir.expressions import Literal as Constant
from swarmdsl.ir.operations import OPERATIONS

Strength = Literal["weaker", "stronger"]
Order = Literal["same", "weaker", "stronger", "unknown"]

_OPPOSITES: dict[Order, Order] = {"weaker": "stronger", "stronger": "weaker"}
# Patterns by how a property depends on its claims: 1 if a weaker claim makes it weaker, else -1.
_POLARITIES = {
    "never": (-1,),
    "always": (1,),
    "eventually": (1,),
    "again": (1,),
    "possible": (1,),
    "leads": (-1, 1),
    "only": (-1, 1),
}
_UPWARD = ("all", "some", "index")
"""Quantifiers of robots with which a fact still holds if it holds for more of them."""
_FOR_ALL_STEPS = ("never", "always", "times")


def strength(before: Property, after: Property) -> Strength | None:
    """Return how the later version of a property differs; None if that is not certain."""
    same = (before.subject, before.each, before.kind) == (after.subject, after.each, after.kind)
    if not same:
        return None
    said = _together(
        (_of_scopes(before, after), _of_claims(before, after), _of_limits(before, after))
    )
    found = _with_chances(before, after, said)
    return found if found in ("weaker", "stronger") else None


def _together(orders: Iterable[Order]) -> Order:
    """Return the order of wholes from those of their parts."""
    found = {*orders} - {"same"}
    return "same" if not found else found.pop() if len(found) == 1 else "unknown"


def _numbers(before: float, after: float) -> Order:
    """Return the order of limits of which the larger one is weaker."""
    return "same" if before == after else "weaker" if before < after else "stronger"


def _with_chances(before: Property, after: Property, said: Order) -> Order:
    was, now = before.chance, after.chance
    bounds = {each.bound for each in (was, now) if each is not None}
    if "most" not in bounds:
        # A property without a chance must be true of each run.
        number = _numbers(-(was.probability if was else 2), -(now.probability if now else 2))
        return _together((said, number))
    if was is None or now is None or len(bounds) > 1:
        return "unknown"
    # The weaker it is, the more often it is true.
    return _together((_OPPOSITES.get(said, said), _numbers(was.probability, now.probability)))


def _of_limits(before: Property, after: Property) -> Order:
    """Return the order of `within` and of `at most N times`."""
    times = _numbers(before.times or 0, after.times or 0)
    was, now = before.within, after.within
    if was == now:
        return times
    lengths = []
    for each in (was, now):
        if each is None:
            lengths.append(inf)
        elif isinstance(each, Constant):
            lengths.append(float(each.value))
        else:
            return "unknown"
    return _together((times, _numbers(*lengths)))


def _of_scopes(before: Property, after: Property) -> Order:
    was, now = before.scope, after.scope
    if was == now:
        return "same"
    if _covers(before, after):
        return "weaker"
    return "stronger" if _covers(after, before) else "unknown"


def _covers(wide: Property, narrow: Property) -> bool:
    """Return True if what holds in one scope holds in the other one too."""
    if narrow.scope is None:
        return False
    whole = wide.kind in _FOR_ALL_STEPS
    if wide.scope is None:
        return whole or (wide.kind == "leads" and narrow.scope.kind == "after")
    kinds = (wide.scope.kind, narrow.scope.kind)
    if kinds == ("until", "between"):
        return wide.scope.claims == narrow.scope.claims
    starts = wide.scope.claims[0] == narrow.scope.claims[0]
    return whole and starts and kinds in (("after", "until"), ("after", "between"))


def _of_claims(before: Property, after: Property) -> Order:
    if before.claims == after.claims:
        return "same"
    if before.kind == "then":
        if _among(after.claims, before.claims):
            return "weaker"
        return "stronger" if _among(before.claims, after.claims) else "unknown"
    polarities = _POLARITIES.get(before.kind)
    if polarities is None:
        return "unknown"
    pairs = zip(before.claims, after.claims, polarities, strict=True)
    return _together(_of_claim(was, now, polarity) for was, now, polarity in pairs)


def _of_claim(was: Claim, now: Claim, polarity: int) -> Order:
    wider, narrower = _implies(was, now), _implies(now, was)
    if wider and narrower:
        return "same"
    found: Order = "weaker" if wider else "stronger" if narrower else "unknown"
    return found if polarity > 0 else _OPPOSITES.get(found, found)


def _among(few: Sequence[Claim], many: Sequence[Claim]) -> bool:
    """Return True if steps that follow each other imply fewer or weaker ones."""
    others = iter(many)
    return all(any(_implies(other, each) for other in others) for each in few)


def _implies(one: Claim, other: Claim) -> bool:
    """Return True if the second claim certainly holds whenever the first one does."""
    if one == other:
        return True
    if isinstance(one, Junction) and one.operator == "or":
        return all(_implies(each, other) for each in one.claims)
    if isinstance(other, Junction) and other.operator == "and":
        return all(_implies(one, each) for each in other.claims)
    if isinstance(one, Junction) and one.operator == "and":
        if any(_implies(each, other) for each in one.claims):
            return True
    elif isinstance(one, Junction) and isinstance(other, Junction) and other.operator == "not":
        return _implies(other.claims[0], one.claims[0])
    if isinstance(other, Junction):
        return other.operator == "or" and any(_implies(one, each) for each in other.claims)
    if isinstance(one, Count) and isinstance(other, Count):
        about = (one.role, one.state) == (other.role, other.state)
        return about and all(
            _compares(number, other)
            for number in range(max(one.number, other.number) + 2)
            if _compares(number, one)
        )
    return isinstance(one, Fact) and isinstance(other, Fact) and _says_more(one, other)


def _compares(number: int, count: Count) -> bool:
    return bool(OPERATIONS[count.comparison](number, count.number))


def _says_more(one: Fact, other: Fact) -> bool:
    """Return True if the first fact names fewer numbers of robots, or more of a condition."""
    if (one.act, one.name) != (other.act, other.name):
        return False
    if one.robots == other.robots and (one.robots is None or one.robots.quantifier in _UPWARD):
        return _is_narrower(one, other)
    if one.robots is None or other.robots is None:
        return False
    ours, theirs = _range(one.robots), _range(other.robots)
    if one.robots.role != other.robots.role or ours is None or theirs is None:
        return False
    # A weaker condition holds for more robots, a stronger one for fewer.
    more = theirs[1] == inf and _is_narrower(one, other)
    fewer = theirs[0] == 0 and _is_narrower(other, one)
    same = (one.guard, one.outcome) == (other.guard, other.outcome)
    if not (same or more or fewer):
        return False
    return theirs[0] <= ours[0] and ours[1] <= theirs[1]


def _is_narrower(one: Fact, other: Fact) -> bool:
    """Return True if the second fact certainly holds of a robot of which the first one does."""
    return other.outcome in ("", one.outcome) and _requires(one.guard, other.guard)


def _requires(one: Expression | None, other: Expression | None) -> bool:
    """Return True if the second condition certainly holds whenever the first one does."""
    if other is None or one == other:
        return True
    if isinstance(other, Binary) and other.operator == "and":
        return _requires(one, other.left) and _requires(one, other.right)
    if isinstance(one, Binary) and one.operator == "and":
        return _requires(one.left, other) or _requires(one.right, other)
    if not (isinstance(one, Binary) and isinstance(other, Binary) and one.left == other.left):
        return False
    ours, theirs = _number(one.right), _number(other.right)
    if ours is None or theirs is None:
        return False
    for strict, closed in (("<", "<="), (">", ">=")):
        if one.operator in (strict, closed, "==") and other.operator in (strict, closed):
            bound = closed if one.operator == strict else other.operator
            return bool(OPERATIONS[bound](ours, theirs))
    return False


def _number(value: Expression) -> int | float | None:
    number = value.value if isinstance(value, Constant) else None
    if isinstance(number, (int, float)) and not isinstance(number, bool):
        return number
    return None


def _range(robots: Robots) -> tuple[float, float] | None:
    """Return the numbers of robots that are meant."""
    if robots.other:
        return None
    if robots.quantifier == "some":
        return 1, inf
    if robots.quantifier == "no":
        return 0, 0
    if robots.quantifier == "number" and robots.number is not None:
        most = robots.number.upper
        return robots.number.lower, inf if most is None else most
    return None
