"""Conditions of guards.

A guard becomes a condition of atoms, joined by `and` and `or`. An atom restricts a term to a
set of values. A term is an expression that is compared with a constant, or a Boolean of which
nothing more is known.
"""

from __future__ import annotations

from collections.abc import Hashable
from functools import lru_cache
from math import inf

from swarmdsl.analysis.checks.conjunctions import negate, satisfiable
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.facts import ALWAYS, Atom, Combined, Condition
from swarmdsl.analysis.checks.value_sets import (
    Numbers,
    Strings,
    all_numbers,
    between,
    compared,
    these,
)
from swarmdsl.analysis.types import Typing, is_float, range_of
from swarmdsl.analysis.types.constant_folding import Folded, Folding
from swarmdsl.analysis.types.unit_rules import in_measure_of
from swarmdsl.syntax.ast import (
    Branch,
    Call,
    Construction,
    Elapsed,
    Element,
    EnumType,
    ExpressionTree,
    FieldUse,
    IndexUse,
    InState,
    NameUse,
    Node,
    OperatorUse,
    Query,
    RoleUse,
    Transition,
    Value,
    walk,
)
from swarmdsl.syntax.types import INTEGERS, Named, Primitive, Type

_MIRRORED = {"==": "==", "!=": "!=", "<": ">", "<=": ">=", ">": "<", ">=": "<="}
_WHOLE = {*INTEGERS, "byte", "char"}
_BOUNDS = {
    **dict.fromkeys(("sqrt", "hypot", "distance"), (0, inf)),
    **dict.fromkeys(("sin", "cos"), (-1, 1)),
}
_TRUE, _TRUE_OR_FALSE = these([1]), these([0, 1])


def guard_condition(tree: ExpressionTree, typing: Typing) -> Condition:
    """Return the condition of a correct guard. A guard without a result does not hold."""
    holds = _condition(tree, typing)
    if not any(_may_fail(part, typing.folding) for part in walk(tree)):
        return holds
    return Combined(
        every=True, parts=(_truth(("has a result", _term(tree, typing.folding))), holds)
    )


def _condition(tree: ExpressionTree, typing: Typing) -> Condition:
    """Condition of a `bool` expression."""
    known = typing.folding.value(tree)
    if isinstance(known, bool):
        return ALWAYS if known else negate(ALWAYS)
    match tree:
        case OperatorUse(operator="and" | "or" as word, operands=operands):
            return Combined(word == "and", tuple(_condition(part, typing) for part in operands))
        case OperatorUse(operator="not", operands=(operand,)):
            return negate(_condition(operand, typing))
        case OperatorUse(operator=operator, operands=(left, right)) if operator in _MIRRORED:
            return _comparison(str(operator), left, right, typing)
    return _truth(_term(tree, typing.folding))


def condition_of(item: Transition | Branch, context: Context) -> Condition:
    """Return the condition under which a triggered transition is taken.

    That of an invalid guard is an atom of its own.
    """
    if item.guard is None:
        return ALWAYS
    return context.conditions.get(item) or _truth(item)


def _may_fail(part: Node, folding: Folding) -> bool:
    """Return True for an operation without a result for some operands.

    Such are a division, the square root, and functions that `inf` and `nan` are no argument of.
    """
    match part:
        case Call(function="div", arguments=(_, divisor)):
            return not folding.value(divisor)
        case OperatorUse(operator="/" | "%", operands=(_, divisor)):
            return not folding.value(divisor)
        case Call(function="sqrt" | "int" | "round" | "floor" | "ceil" | "sin" | "cos") as tree:
            return folding.value(tree) is None
        case IndexUse() | Query(function="min" | "max"):
            return True
    return False


def guard_value(item: Transition | Branch, context: Context) -> bool | None:
    """Return True or False for a guard that always or never holds, None for any other."""
    if item.guard is None:
        return True
    if item not in context.guard_values:
        holds = condition_of(item, context)
        if not satisfiable(holds):
            context.guard_values[item] = False
        else:
            context.guard_values[item] = None if satisfiable(negate(holds)) else True
    return context.guard_values[item]


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
        return holds if value is (operator == "==") else negate(holds)
    if not isinstance(value, str):
        value = in_measure_of(typing.infer(left), value, typing.infer(right))
    return _compared(operator, left, value, typing)


def _compared(operator: str, tree: ExpressionTree, value: Folded, typing: Typing) -> Condition:
    """Condition of a comparison of a term with a constant."""
    if isinstance(value, str):
        strings = Strings(frozenset({value}))
        held = strings if operator == "==" else strings.complement()
        return Atom(_term(tree, typing.folding), held, Strings(frozenset(), others=True))
    known = _range(tree, typing.infer(tree), typing)
    return Atom(_term(tree, typing.folding), compared(operator, value, whole=known.whole), known)


def _range(tree: ExpressionTree, type_: Type | None, typing: Typing) -> Numbers:
    """Possible numbers of a term.

    An enum in a message is 0 at first, even if none of its values is.
    """
    if isinstance(tree, (Call, Query)) and tree.function in ("len", "count"):
        return compared(">=", 0, whole=True)
    if isinstance(tree, Call) and tree.function in _BOUNDS:
        low, high = _BOUNDS[str(tree.function)]
        return Numbers((((low, 0), (high, 0)),), nan=True)
    if isinstance(type_, Named):
        enum = typing.interfaces.get(type_)
        if isinstance(enum, EnumType):
            return _enum(tuple(typing.folding.numbers(enum).values()))
    # A stored number fits in its type; a computed one may not.
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
    """Condition of a comparison of two terms, the same if the sides are exchanged.

    A term equals itself, except for NaN.
    """
    first, second = _term(left, typing.folding), _term(right, typing.folding)
    if first == second:
        if operator in ("<", ">"):
            return negate(ALWAYS)
        type_ = typing.infer(left)
        if type_ is not None and not is_float(type_):
            return negate(ALWAYS) if operator == "!=" else ALWAYS
    if operator in (">", ">=") or (operator in ("==", "!=") and hash(first) > hash(second)):
        operator, first, second = _MIRRORED[operator], second, first
    if operator == "!=":
        return negate(_truth(("==", first, second)))
    return _truth((operator, first, second))


def _truth(term: Hashable) -> Condition:
    return Atom(("holds", term), _TRUE, _TRUE_OR_FALSE)


def _term(tree: ExpressionTree, folding: Folding) -> Hashable:
    """Key of an expression: expressions with the same key have the same value at one moment."""
    value = folding.value(tree)
    if value is not None:
        return (type(value), value)
    match tree:
        case Value(value=value, unit=unit):
            return (type(value), value, unit)
        case NameUse(name=name, target=Element()):
            return name  # the same in another query
        case NameUse(name=name, target=target):
            return target or name
        case RoleUse(name=name):
            return ("role", name)
        case FieldUse(base=base, name=name):
            return (_term(base, folding), str(name))
        case Call(function=word, arguments=operands):
            return (str(word), *(_term(operand, folding) for operand in operands))
        case OperatorUse(operator=word, operands=operands):
            return (str(word), *(_term(operand, folding) for operand in operands))
        case IndexUse(base=base, index=index):
            return ("[]", _term(base, folding), _term(index, folding))
        case Query(function=word, element=element, condition=condition, key=key):
            parts = (element.array, condition, key)
            terms = (None if part is None else _term(part, folding) for part in parts)
            return (str(word), str(element.name), *terms)
        case InState(state=state):
            return ("in", state.target or state.name)
        case Elapsed(owner=owner):
            return ("elapsed", owner or id(tree))
        case Construction(type=type_, values=values):
            return (type_.type, *((str(e.name), _term(e.value, folding)) for e in values))
    raise AssertionError(tree)
