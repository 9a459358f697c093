"""Values of ECMAScript: conversions and copies.

Integral numbers are `int`, so that they are printed and used as indices like in ECMAScript; `null`
and `undefined` are both `None`.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from typing import Any

from swarmdsl.execution.engine import ExecutionError

_EXACT = 2**53
_DECIMAL = re.compile(r"[+-]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|Infinity)")
_HEXADECIMAL = re.compile("0[xX][0-9a-fA-F]+")
# A document could double a string or a list over and over.
LONGEST = 1_000_000
_DEEPEST = 100


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
        return value if isinstance(value, float) else whole(value)
    if isinstance(value, str):
        written = value.strip()
        if _HEXADECIMAL.fullmatch(written):
            return whole(int(written, 16))
        if _DECIMAL.fullmatch(written):
            return whole(float(written))
        return math.nan if written else 0
    return math.nan if value is None else number(text(value))


def whole(value: float | int) -> float | int:
    """Convert an integral number to `int`, in the range of exact integers."""
    if isinstance(value, int):
        if -_EXACT <= value <= _EXACT:
            return value
        try:
            return float(value)
        except OverflowError:
            return math.inf if value > 0 else -math.inf
    return int(value) if value.is_integer() and -_EXACT <= value <= _EXACT else value


def code_units(value: str) -> int:
    """Return the length of a string, in which characters above U+FFFF count twice."""
    return len(value) + sum(each > "\uffff" for each in value)


def text(value: Any, depth: int = 0) -> str:
    """Convert a value to a string."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if value is None:
        return "undefined"
    if isinstance(value, float):
        return _written(value)
    if isinstance(value, list):
        return joined(value, ",", depth + 1)
    return str(value) if not isinstance(value, dict) else "[object Object]"


def joined(values: list[Any], separator: str, depth: int) -> str:
    """Convert a list to a string; elements without a value are empty."""
    if depth > _DEEPEST:
        raise ExecutionError("the list is nested too deeply")
    parts, size = [], 0
    for each in values:
        parts.append("" if each is None else text(each, depth))
        size += len(parts[-1]) + 1
        if size > LONGEST:
            raise ExecutionError("the string is too long")
    return separator.join(parts)


def copied(value: Any) -> Any:
    """Return a copy of a value, like `JSON.parse(JSON.stringify(value))`."""
    left = [LONGEST]

    def copy(each: Any, depth: int) -> Any:
        left[0] -= 1
        if depth > _DEEPEST or left[0] < 0:
            raise ExecutionError("the value is too large to be copied")
        if isinstance(each, list):
            return [copy(inner, depth + 1) for inner in each]
        if isinstance(each, dict):
            return {key: copy(inner, depth + 1) for key, inner in each.items()}
        return each

    return copy(value, 0)


def contains(held: Any, name: Any) -> bool:
    """Return True if an object has a member: the operator `in`."""
    if isinstance(held, list):
        return name == "length" or text(name) in map(str, range(len(held)))
    if isinstance(held, dict):
        return text(name) in held
    raise ExecutionError(f"`in` needs an object or list, not `{text(held)}`")


def _written(value: float) -> str:
    """Format a number like Number.prototype.toString."""
    if not math.isfinite(value):
        return {math.inf: "Infinity", -math.inf: "-Infinity"}.get(value, "NaN")
    if value.is_integer() and abs(value) < 1e21:
        return str(int(value))
    if 1e-6 <= abs(value) < 1e-4:
        return format(Decimal(repr(value)), "f")
    return re.sub("e([+-])0+", r"e\1", repr(value))
