"""The values of expressions that are known when the model is compiled."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl.ir import Binary, Call, Expression, Literal, Param, ParamRef, Unary
from swarmdsl.ir.types import DURATION

Value = bool | int | float | str

_OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    "or": lambda left, right: left or right,
    "and": lambda left, right: left and right,
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
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "min": min,
    "max": max,
    "abs": abs,
    "sqrt": math.sqrt,
    "len": len,
}


def constant(expression: Expression, params: Mapping[str, Param]) -> Value | None:
    """The value of an expression of literals and of params with a default; None for others.

    Durations are in seconds, as rospy takes them.
    """
    try:
        value: Value = _value(expression, params)
    except (LookupError, ArithmeticError, ValueError):
        return None
    if expression.type == DURATION and isinstance(value, int):
        return value / 1_000_000_000
    return value


def params_by_name(params: tuple[Param, ...]) -> dict[str, Param]:
    """The params that an expression can mean."""
    return {param.name: param for param in params}


def _value(expression: Expression, params: Mapping[str, Param]) -> Any:
    match expression:
        case Literal(value=value):
            return value
        case ParamRef(name=name):
            default = params[name].default
            if default is None:
                raise LookupError(name)
            return _value(default, params)
        case Unary(operator="not", operand=operand):
            return not _value(operand, params)
        case Unary(operand=operand):
            return -_value(operand, params)
        case Binary(operator=symbol, left=left, right=right):
            return _OPERATORS[symbol](_value(left, params), _value(right, params))
        case Call(function=function, arguments=arguments):
            return _FUNCTIONS[function](*(_value(argument, params) for argument in arguments))
    raise LookupError(expression)
