"""Values of expressions that are known at compile time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from swarmdsl.base.source import Span
from swarmdsl.ir import Binary, Call, Expression, Literal, Param, ParamRef, Unary
from swarmdsl.ir.operations import OPERATIONS
from swarmdsl.syntax.types import DURATION

Value = bool | int | float | str


class UnknownValueError(Exception):
    """The value is not known at compile time."""


class UndefinedValueError(Exception):
    """An operation has no result, or none that is a finite number."""

    def __init__(self, operator: str, operands: list[str], origin: Span | None) -> None:
        super().__init__(operator, operands, origin)
        self.operator = operator
        self.operands = operands
        self.origin = origin


def constant(expression: Expression, params: Mapping[str, Param]) -> Value | None:
    """Return the value of an expression as `evaluate` does, or None."""
    try:
        return evaluate(expression, params)
    except (UnknownValueError, UndefinedValueError):
        return None


def evaluate(expression: Expression, params: Mapping[str, Param]) -> Value:
    """Return the value of an expression of literals and params with a default.

    Durations are in seconds, as in rospy. Raises UnknownValueError or UndefinedValueError.
    """
    value: Value = _value(expression, params)
    if expression.type != DURATION:
        return value
    return value / 1_000_000_000  # type: ignore[operator]  # a duration is a number


def params_by_name(params: tuple[Param, ...]) -> dict[str, Param]:
    """Return the params that an expression can refer to, by name."""
    return {param.name: param for param in params}


def _value(expression: Expression, params: Mapping[str, Param]) -> Any:
    """Return the value; durations in nanoseconds."""
    match expression:
        case Literal(value=value):
            return value
        case ParamRef(name=name):
            default = params[name].default if name in params else None
            if default is None:
                raise UnknownValueError
            return _value(default, params)
        case Unary(operator="not", operand=operand):
            return not _value(operand, params)
        case Unary(operand=operand):
            return -_value(operand, params)
        case Binary(operator="or", left=left, right=right):
            return _value(left, params) or _value(right, params)
        case Binary(operator="and", left=left, right=right):
            return _value(left, params) and _value(right, params)
        case Binary(operator=symbol, left=left, right=right):
            return _apply(symbol, (left, right), params, expression.origin)
        case Call(function=function, arguments=arguments) if function in OPERATIONS:
            return _apply(function, arguments, params, expression.origin)
    raise UnknownValueError


def _apply(
    operation: str,
    operands: tuple[Expression, ...],
    params: Mapping[str, Param],
    origin: Span | None,
) -> Any:
    values = [_value(operand, params) for operand in operands]
    try:
        result = OPERATIONS[operation](*values)
        if not isinstance(result, float) or math.isfinite(result):
            return result
    except (ArithmeticError, ValueError):
        pass
    raise UndefinedValueError(operation, [_text(operand) for operand in operands], origin)


def _text(operand: Expression) -> str:
    """Return an operand as in the model."""
    if isinstance(operand, Literal) and operand.type != DURATION:
        return str(operand.value)
    return operand.origin.text if operand.origin is not None else repr(operand)
