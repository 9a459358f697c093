"""The values of expressions that are known when a model is compiled."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl.enums import numbers
from swarmdsl.expressions import nanoseconds
from swarmdsl.graph import leaves_first
from swarmdsl.syntax import (
    Call,
    Constant,
    EnumType,
    ExpressionTree,
    FieldUse,
    NameUse,
    OperatorUse,
    Value,
    walk,
)

Folded = bool | int | float | str
Constants = dict[Constant, Folded | None]

_OPERATIONS: Mapping[str, Callable[..., Folded]] = {
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "%": operator.mod,
    "min": min,
    "max": max,
    "abs": abs,
    "sqrt": math.sqrt,
    "len": len,
}
# What 64 bits hold: an `int64` or a `uint64`, and a duration in nanoseconds.
_WHOLE, _LENGTHS = range(-(2**63), 2**64), range(-(2**63), 2**63)


class _UndefinedError(Exception):
    """An operation on known operands has no result that any target can hold."""


def fold(tree: ExpressionTree, known: Constants | None = None) -> Folded | None:
    """The value of an expression, durations in nanoseconds; None when it is not known.

    `and` and `or` are known where one side decides. An expression that has no value (a
    division by zero) is None too: `undefined` says why. What constants are found to be is kept
    in `known`.
    """
    known = {} if known is None else known

    def needed(tree: ExpressionTree | None) -> list[Constant]:
        return [constant for constant in _constants(tree) if constant not in known]

    for constant in leaves_first(needed(tree), lambda each: needed(each.value.tree)):
        known[constant] = _folded(constant.value.tree, known)
    return _folded(tree, known)


def undefined(
    tree: Call | OperatorUse, known: Constants | None = None, *, duration: bool = False
) -> str | None:
    """Why an operation has no result, whatever its unknown operands are; None where it has one.

    It is the operation itself that is looked at: of operands without a value nothing is said.
    `duration` says that the result is one.
    """
    operands = tree.arguments if isinstance(tree, Call) else tree.operands
    values = [fold(operand, known) for operand in operands]
    word = str(tree.function if isinstance(tree, Call) else tree.operator)
    if word in ("/", "%") and _is_zero(values[-1]):
        return "the divisor is 0"
    if None in values or word in ("and", "or", "not"):
        return None
    try:
        result = _negative(values[0]) if (word, len(values)) == ("-", 1) else _apply(word, values)
    except _UndefinedError as error:
        return str(error)
    except TypeError:
        return None
    if duration and isinstance(result, (int, float)) and round(result) not in _LENGTHS:
        return "it would be longer than 292 years"
    return None


def _constants(tree: ExpressionTree | None) -> list[Constant]:
    """The constants that an expression names."""
    nodes = walk(tree) if tree is not None else ()
    return [
        node.target
        for node in nodes
        if isinstance(node, NameUse) and isinstance(node.target, Constant)
    ]


def _folded(tree: ExpressionTree | None, known: Mapping[Constant, Folded | None]) -> Folded | None:
    try:
        return _Folding(known).fold(tree) if tree is not None else None
    except (_UndefinedError, TypeError):
        return None


class _Folding:
    """A walk over an expression; of the constants in it the values are known before."""

    def __init__(self, known: Mapping[Constant, Folded | None]) -> None:
        self._known = known

    def fold(self, tree: ExpressionTree) -> Folded | None:
        match tree:
            case Value(value=bool() | str() as value):
                return value
            case Value(unit=unit, value=value):
                return nanoseconds(tree.span.text, unit) if unit else value
            case NameUse(target=Constant() as constant):
                return self._known[constant]
            case FieldUse(base=NameUse(target=EnumType() as enum), name=name):
                return numbers(enum).get(str(name))
            case Call(function=function, arguments=arguments) if function in _OPERATIONS:
                return self._applied(str(function), arguments)
            case OperatorUse(operator="and" | "or" as word, operands=operands):
                return self._logic(word == "or", operands)
            case OperatorUse(operator="not", operands=(operand,)):
                known = self.fold(operand)
                return None if known is None else not known
            case OperatorUse(operands=(operand,)):
                return _negative(self.fold(operand))
            case OperatorUse(operator=word, operands=operands):
                return self._applied(str(word), operands)
        return None

    def _applied(self, word: str, operands: tuple[ExpressionTree, ...]) -> Folded | None:
        values = [self.fold(operand) for operand in operands]
        return None if None in values else _apply(word, values)

    def _logic(self, decisive: bool, operands: tuple[ExpressionTree, ...]) -> Folded | None:
        values = [self.fold(operand) for operand in operands]
        if any(value is decisive for value in values):
            return decisive
        return None if None in values else not decisive


def _apply(word: str, values: list[Any]) -> Folded:
    try:
        result = _OPERATIONS[word](*values)
    except ZeroDivisionError:
        raise _UndefinedError("the divisor is 0") from None
    except OverflowError:
        raise _UndefinedError("it would be too large for a `float64`") from None
    except ValueError:
        raise _UndefinedError(f"{values[0]} has no square root") from None
    return _held(result)


def _negative(value: Folded | None) -> Folded | None:
    return _held(-value) if isinstance(value, (int, float)) else None


def _held(result: Folded) -> Folded:
    """The result itself, if 64 bits hold it."""
    if isinstance(result, float) and not math.isfinite(result):
        raise _UndefinedError("it would be too large for a `float64`")
    if isinstance(result, int) and result not in _WHOLE:
        raise _UndefinedError("it does not fit in 64 bits")
    return result


def _is_zero(value: Folded | None) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value == 0
