"""The values of expressions that are known when a model is compiled."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl.enums import numbers
from swarmdsl.expressions import UNITS
from swarmdsl.syntax import (
    Call,
    Constant,
    EnumType,
    ExpressionTree,
    FieldUse,
    NameUse,
    OperatorUse,
    Value,
)

Folded = bool | int | float | str

_OPERATORS: Mapping[str, Callable[[Any, Any], Folded]] = {
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
}
_FUNCTIONS: Mapping[str, Callable[..., Folded]] = {
    "min": min,
    "max": max,
    "abs": abs,
    "sqrt": math.sqrt,
    "len": len,
}


def fold(tree: ExpressionTree) -> Folded | None:
    """The value of an expression, durations in nanoseconds; None when it is not known.

    `and` and `or` are known where one side decides. An expression that has no value (a
    division by zero) is None too: it is reported elsewhere.
    """
    try:
        return _fold(tree)
    except (ArithmeticError, ValueError, TypeError):
        return None


def _fold(tree: ExpressionTree) -> Folded | None:
    match tree:
        case Value(value=bool() | str() as value):
            return value
        case Value(value=value, unit=unit):
            assert not isinstance(value, (bool, str))
            return value * UNITS[unit] if unit else value
        case NameUse(target=Constant(value=expression)):
            return _fold(expression.tree) if expression.tree is not None else None
        case FieldUse(base=NameUse(target=EnumType() as enum), name=name):
            return numbers(enum).get(str(name))
        case Call(function=function, arguments=arguments) if function in _FUNCTIONS:
            values = [_fold(argument) for argument in arguments]
            return None if None in values else _FUNCTIONS[function](*values)
        case OperatorUse(operator="and" | "or" as word, operands=operands):
            return _fold_logic(word == "or", operands)
        case OperatorUse(operator="not", operands=(operand,)):
            known = _fold(operand)
            return None if known is None else not known
        case OperatorUse(operands=(operand,)):
            known = _fold(operand)
            return -known if isinstance(known, (int, float)) else None
        case OperatorUse(operator=word, operands=(left, right)):
            first, second = _fold(left), _fold(right)
            if first is None or second is None:
                return None
            return _OPERATORS[word](first, second)
    return None


def _fold_logic(decisive: bool, operands: tuple[ExpressionTree, ...]) -> Folded | None:
    values = [_fold(operand) for operand in operands]
    if any(value is decisive for value in values):
        return decisive
    return None if None in values else not decisive
