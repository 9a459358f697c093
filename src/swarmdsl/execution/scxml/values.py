"""ECMAScript conversions, comparisons and arithmetic.

Integral numbers are `int`, so that they are printed and used as indices like in ECMAScript; `null`
and `undefined` are both `None`.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from decimal import Decimal
from typing import Any

from swarmdsl.execution.engine import ExecutionError

_EXACT = 2**53
_DECIMAL = re.compile(r"[+-]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|Infinity)")
_HEXADECIMAL = re.compile("0[xX][0-9a-fA-F]+")
# A document could double a string over and over.
_LONGEST = 1_000_000


def truth(value: Any) -> bool:
    """Return True for a truthy value."""
    if isinstance(value, (list, dict)):
        return True
    return bool(value) and value == value


def number(value: Any) -> float | int:
    """Convert a value to a number; NaN if impossible."""
    if isinstance(value, bool):
        return int(value)
    if isinstance(value, (int, float)):
        return value
    if isinstance(value, str):
        written = value.strip()
        if _HEXADECIMAL.fullmatch(written):
            return whole(int(written, 16))
        if _DECIMAL.fullmatch(written):
            return whole(float(written))
        return math.nan if written else 0
    return math.nan


def whole(value: float | int) -> float | int:
    """Convert an integral number to `int`, in the range of exact integers."""
    if isinstance(value, int):
        return value if -_EXACT <= value <= _EXACT else float(value)
    return int(value) if value.is_integer() and -_EXACT <= value <= _EXACT else value


def text(value: Any) -> str:
    """Convert a value to a string."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if value is None:
        return "undefined"
    if isinstance(value, float):
        return _written(value)
    if isinstance(value, list):
        return ",".join(map(text, value))
    return str(value) if not isinstance(value, dict) else "[object Object]"


def _written(value: float) -> str:
    """Format a number like Number.prototype.toString."""
    if not math.isfinite(value):
        return {math.inf: "Infinity", -math.inf: "-Infinity"}.get(value, "NaN")
    if value.is_integer() and abs(value) < 1e21:
        return str(int(value))
    if 1e-6 <= abs(value) < 1e-4:
        return format(Decimal(repr(value)), "f")
    return re.sub("e([+-])0+", r"e\1", repr(value))


def _add(left: Any, right: Any) -> Any:
    if isinstance(left, (str, list, dict)) or isinstance(right, (str, list, dict)):
        both = text(left) + text(right)
        if len(both) > _LONGEST:
            raise ExecutionError("the string is too long")
        return both
    return whole(number(left) + number(right))


def _divide(left: Any, right: Any) -> float | int:
    dividend, divisor = number(left), number(right)
    if divisor == 0:
        return dividend * math.inf if dividend and dividend == dividend else math.nan
    return whole(dividend / divisor)


def _remainder(left: Any, right: Any) -> float | int:
    dividend, divisor = number(left), number(right)
    if divisor == 0 or math.isinf(dividend):
        return math.nan
    return whole(math.fmod(dividend, divisor))


def _same(left: Any, right: Any) -> bool:
    if isinstance(left, (list, dict)) or isinstance(right, (list, dict)):
        return left is right
    return _kind(left) == _kind(right) and bool(left == right)


def _alike(left: Any, right: Any) -> bool:
    if _kind(left) == _kind(right) or left is None or right is None:
        return _same(left, right)
    return number(left) == number(right)


def _kind(value: Any) -> str:
    if isinstance(value, bool):
        return "boolean"
    if isinstance(value, (int, float)):
        return "number"
    if value is None:
        return "undefined"
    return "string" if isinstance(value, str) else "object"


def _compared(test: Callable[[Any, Any], bool]) -> Callable[[Any, Any], bool]:
    def compare(left: Any, right: Any) -> bool:
        if isinstance(left, str) and isinstance(right, str):
            return test(left, right)
        return test(number(left), number(right))

    return compare


def _numeric(function: Callable[..., Any]) -> Callable[..., Any]:
    def call(*values: Any) -> Any:
        try:
            return whole(function(*map(number, values)))
        except (ArithmeticError, ValueError):
            return math.nan

    return call


def _extreme(choose: Callable[[list[float]], float]) -> Callable[..., float]:
    def call(*given: Any) -> float:
        values = [number(each) for each in given]
        return math.nan if any(map(math.isnan, values)) else choose(values)

    return call


OPERATIONS: Mapping[str, Callable[[Any, Any], Any]] = {
    "+": _add,
    "-": lambda left, right: whole(number(left) - number(right)),
    "*": lambda left, right: whole(number(left) * number(right)),
    "/": _divide,
    "%": _remainder,
    "===": _same,
    "!==": lambda left, right: not _same(left, right),
    "==": _alike,
    "!=": lambda left, right: not _alike(left, right),
    "<": _compared(lambda left, right: left < right),
    "<=": _compared(lambda left, right: left <= right),
    ">": _compared(lambda left, right: left > right),
    ">=": _compared(lambda left, right: left >= right),
}
SIGNS: Mapping[str, Callable[[Any], Any]] = {
    "!": lambda value: not truth(value),
    "-": lambda value: whole(-number(value)),
    "+": number,
    "typeof": _kind,
}
FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "Math.abs": _numeric(abs),
    "Math.ceil": _numeric(math.ceil),
    "Math.floor": _numeric(math.floor),
    "Math.round": _numeric(lambda value: math.floor(value + 0.5)),
    "Math.trunc": _numeric(math.trunc),
    "Math.sqrt": _numeric(math.sqrt),
    "Math.pow": _numeric(pow),
    "Math.min": _extreme(lambda values: min(values, default=math.inf)),
    "Math.max": _extreme(lambda values: max(values, default=-math.inf)),
}
