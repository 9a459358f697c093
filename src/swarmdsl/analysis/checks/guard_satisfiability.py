"""What guards say together: whether values exist for which all of them hold.

A guard becomes `and` and `or` of atoms; an atom says in which set of values a term lies. A
term is whatever is compared with a constant, or a truth value of which nothing more is known.
At one moment a term has one value, so two guards that are looked at together agree about it.
What comes out is certain: where it would take too long, values are said to exist.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from functools import lru_cache

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.value_sets import (
    Numbers,
    Texts,
    Values,
    all_numbers,
    between,
    compared,
    these,
)
from swarmdsl.analysis.types import Typing, is_float, range_of
from swarmdsl.analysis.types.constant_folding import Folded, Folding
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import (
    Branch,
    Call,
    EnumType,
    ExpressionTree,
    FieldUse,
    NameUse,
    Node,
    OperatorUse,
    Transition,
    Value,
    walk,
)
from swarmdsl.syntax.types import INTEGERS, Named, Primitive, Type

_MIRRORED = {"==": "==", "!=": "!=", "<": ">", "<=": ">=", ">": "<", ">=": "<="}
_WHOLE = {*INTEGERS, "byte", "char"}
_TRUE, _TRUE_OR_FALSE = these([1]), these([0, 1])
# More alternatives than people write; each is a step of the search.
_MOST_STEPS = 2_000


@dataclass(frozen=True)
class Atom:
    """The value of a term is one of `values`; it could be any of `range`."""

    term: Hashable
    values: Values
    range: Values


@dataclass(frozen=True)
class Combined:
    """All parts hold, or (`every` False) one of them."""

    every: bool
    parts: tuple[Condition, ...] = ()


Condition = Atom | Combined
# Without parts: all of none hold, and one of none does not.
ALWAYS = Combined(every=True)


def guard_condition(tree: ExpressionTree, typing: Typing) -> Condition:
    """The condition that a guard without mistakes is: one that has no result does not hold."""
    holds = _condition(tree, typing)
    if not any(_may_fail(part, typing.folding) for part in walk(tree)):
        return holds
    return Combined(
        every=True, parts=(_truth(("has a result", _term(tree, typing.folding))), holds)
    )


def _condition(tree: ExpressionTree, typing: Typing) -> Condition:
    """The condition that a `bool` expression is."""
    known = typing.folding.value(tree)
    if isinstance(known, bool):
        return ALWAYS if known else negated(ALWAYS)
    match tree:
        case OperatorUse(operator="and" | "or" as word, operands=operands):
            return Combined(word == "and", tuple(_condition(part, typing) for part in operands))
        case OperatorUse(operator="not", operands=(operand,)):
            return negated(_condition(operand, typing))
        case OperatorUse(operator=operator, operands=(left, right)) if operator in _MIRRORED:
            return _comparison(str(operator), left, right, typing)
    return _truth(_term(tree, typing.folding))


def negated(some: Condition) -> Condition:
    """The condition that holds where this one does not."""
    if isinstance(some, Combined):
        return Combined(not some.every, tuple(negated(part) for part in some.parts))
    return Atom(some.term, some.values.complement(), some.range)


def condition_of(item: Transition | Branch, context: Context) -> Condition:
    """The condition under which a transition is taken when it is triggered.

    Of a guard that is wrong nothing is known.
    """
    if item.guard is None:
        return ALWAYS
    return context.conditions.get(item) or _truth(item)


def _may_fail(part: Node, folding: Folding) -> bool:
    """Whether an operation may have no result: a division by zero, the root of less."""
    match part:
        case OperatorUse(operator="/" | "%", operands=(_, divisor)):
            return not folding.value(divisor)
        case Call(function="sqrt") as tree:
            return folding.value(tree) is None
    return False


def certain(item: Transition | Branch, context: Context) -> bool | None:
    """Whether the guard holds for all values, or for none; None where it depends on them."""
    if item.guard is None:
        return True
    if item not in context.certain:
        holds = condition_of(item, context)
        if not possible([holds]):
            context.certain[item] = False
        else:
            context.certain[item] = None if possible([negated(holds)]) else True
    return context.certain[item]


def possible(conditions: Iterable[Condition]) -> bool:
    """Whether there are values for which all of the conditions hold."""
    together = list(conditions)
    if len(together) == 1 and isinstance(together[0], Atom):
        return together[0].range.meets(together[0].values)  # type: ignore[arg-type]
    found: dict[Hashable, Values] = {}
    ahead = [(together, found)]
    for _ in range(_MOST_STEPS):
        if not ahead:
            return False
        pending, found = ahead.pop()
        found = dict(found)
        forks: list[Combined] = []
        if _hold(pending, found, forks):
            if not forks:
                return True
            first, *others = forks
            ahead += [([*others, part], found) for part in reversed(first.parts)]
    return bool(ahead)


def _hold(pending: list[Condition], found: dict[Hashable, Values], forks: list[Combined]) -> bool:
    """Add the values that conditions leave to `found`; False where they leave none.

    Those of which one must hold become `forks`.
    """
    while pending:
        part = pending.pop()
        if isinstance(part, Atom):
            term = (part.term, type(part.range))
            # Both sets are of one kind, which is a part of the name of the term.
            left = found.get(term, part.range) & part.values  # type: ignore[operator]
            if not left:
                return False
            found[term] = left
        elif part.every:
            pending += part.parts
        else:
            forks.append(part)
    return True


def _comparison(
    operator: str, left: ExpressionTree, right: ExpressionTree, typing: Typing
) -> Condition:
    value = typing.folding.value(right)
    if value is None:
        value, left, right = typing.folding.value(left), right, left
        operator = _MIRRORED[operator]
    if value is None:
        return _relation(operator, left, right, typing)
    if isinstance(value, bool):
        holds = _condition(left, typing)
        return holds if value is (operator == "==") else negated(holds)
    return _compared(operator, left, value, typing)


def _compared(operator: str, tree: ExpressionTree, value: Folded, typing: Typing) -> Condition:
    """The comparison of a term with a constant."""
    if isinstance(value, str):
        texts = Texts(frozenset({value}))
        held = texts if operator == "==" else texts.complement()
        return Atom(_term(tree, typing.folding), held, Texts(frozenset(), others=True))
    known = _range(tree, typing.infer(tree), typing)
    return Atom(_term(tree, typing.folding), compared(operator, value, whole=known.whole), known)


def _range(tree: ExpressionTree, type_: Type | None, typing: Typing) -> Numbers:
    """The numbers that a term may be.

    An enum in a message begins as 0, whether or not that is one of its values.
    """
    if isinstance(tree, Call) and tree.function == "len":
        return compared(">=", 0, whole=True)
    if isinstance(type_, Named):
        enum = typing.interfaces.get(type_)
        if isinstance(enum, EnumType):
            return _enum(tuple(typing.folding.numbers(enum).values()))
    # What is stored fits in its type; what is computed with it may not.
    held = range_of(type_) if isinstance(tree, (NameUse, FieldUse)) else None
    if held is not None:
        return between(held[0], held[-1])
    whole = isinstance(type_, Primitive) and type_.name in _WHOLE
    return all_numbers(whole=whole)


@lru_cache(maxsize=100)
def _enum(numbers: tuple[int, ...]) -> Numbers:
    return these([0, *numbers])


def _relation(
    operator: str, left: ExpressionTree, right: ExpressionTree, typing: Typing
) -> Condition:
    """The comparison of two terms: a truth value; the same one when its sides are exchanged.

    A term is as great as itself, except for what is not a number.
    """
    first, second = _term(left, typing.folding), _term(right, typing.folding)
    if first == second:
        if operator in ("<", ">"):
            return negated(ALWAYS)
        type_ = typing.infer(left)
        if type_ is not None and not is_float(type_):
            return negated(ALWAYS) if operator == "!=" else ALWAYS
    if operator in (">", ">=") or (operator in ("==", "!=") and hash(first) > hash(second)):
        operator, first, second = _MIRRORED[operator], second, first
    if operator == "!=":
        return negated(_truth(("==", first, second)))
    return _truth((operator, first, second))


def _truth(term: Hashable) -> Condition:
    return Atom(("holds", term), _TRUE, _TRUE_OR_FALSE)


def _term(tree: ExpressionTree, folding: Folding) -> Hashable:
    """What two expressions have in common that have the same value at one moment."""
    value = folding.value(tree)
    if value is not None:
        return (type(value), value)
    match tree:
        case Value(value=value, unit=unit):
            return (type(value), value, unit)
        case NameUse(name=name, target=target):
            return target or name
        case FieldUse(base=base, name=name):
            return (_term(base, folding), str(name))
        case Call(function=word, arguments=operands):
            return (str(word), *(_term(operand, folding) for operand in operands))
        case OperatorUse(operator=word, operands=operands):
            return (str(word), *(_term(operand, folding) for operand in operands))
    raise AssertionError(tree)
