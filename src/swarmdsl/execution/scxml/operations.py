"""Operators and functions of ECMAScript."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

from swarmdsl.execution.engine import ExecutionError
from swarmdsl.execution.scxml.values import LONGEST, joined, number, text, truth, whole


def _primitive(value: Any) -> Any:
    """Convert a list or object to a string, as operators do."""
    return text(value) if isinstance(value, (list, dict)) else value


def _add(left: Any, right: Any) -> Any:
    if isinstance(left, (str, list, dict)) or isinstance(right, (str, list, dict)):
        both = text(left) + text(right)
        if len(both) > LONGEST:
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
    left, right = _primitive(left), _primitive(right)
    if _kind(left) == _kind(right):
        return bool(left == right)
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
        left, right = _primitive(left), _primitive(right)
        if isinstance(left, str) and isinstance(right, str):
            return test(left, right)
        return test(number(left), number(right))

    return compare


def _numeric(function: Callable[[float], float]) -> Callable[[Any], float]:
    def call(given: Any) -> float:
        value = number(given)
        if not math.isfinite(value) and function is not abs:
            return math.nan if function is math.sqrt and value < 0 else value
        try:
            return whole(function(value))
        except ValueError:
            return math.nan

    return call


def _power(base: Any, exponent: Any) -> float:
    """Return `Math.pow`: as numbers without a limit, powers could take for ever."""
    of, by = float(number(base)), float(number(exponent))
    if math.isnan(by) or (abs(of) == 1 and math.isinf(by)):
        return math.nan
    try:
        return whole(math.pow(of, by))
    except OverflowError:
        return -math.inf if of < 0 and by % 2 else math.inf
    except ValueError:
        # A root of a negative number, or a division by zero.
        if of:
            return math.nan
        return math.copysign(math.inf, of) if by % 2 == 1 else math.inf


def _rounded(value: float) -> float:
    """Return the nearest integer, the greater one of two; without an error of rounding."""
    below = math.floor(value)
    return below + (value - below >= 0.5)


def _of_reals(function: Callable[..., float]) -> Callable[..., float]:
    def call(*given: Any) -> float:
        try:
            return whole(function(*(float(number(each)) for each in given)))
        except ValueError:
            return math.nan

    return call


def _extreme(choose: Callable[[list[float]], float]) -> Callable[..., float]:
    def call(*given: Any) -> float:
        values = [number(each) for each in given]
        return math.nan if any(map(math.isnan, values)) else choose(values)

    return call


def _bits(value: Any) -> int:
    """Convert a value to a whole number of 32 bits with a sign."""
    found = number(value)
    if not math.isfinite(found):
        return 0
    return (math.trunc(found) + 2**31) % 2**32 - 2**31


def _bitwise(function: Callable[[int, int], int]) -> Callable[[Any, Any], int]:
    return lambda left, right: _bits(function(_bits(left), _bits(right)))


def _concat(held: Any, *given: Any) -> Any:
    """Append values, and the elements of lists, to a copy of a list; or join strings."""
    if isinstance(held, str):
        made: Any = held + "".join(map(text, given))
    elif isinstance(held, list):
        made = list(held)
        for each in given:
            made += each if isinstance(each, list) else [each]
    else:
        raise ExecutionError(f"`{text(held)}` has no function `concat`")
    if len(made) > LONGEST:
        raise ExecutionError("the string or list is too long")
    return made


def _slice(values: Any, start: Any = 0, end: Any = None) -> Any:
    if not isinstance(values, (list, str)):
        raise ExecutionError(f"`{text(values)}` has no `slice`")
    if not all(each is None or isinstance(each, int) for each in (start, end)):
        raise ExecutionError("`slice` takes integers")
    return values[start:end]


def _assigned(target: Any, source: Any) -> dict[str, Any]:
    if not isinstance(target, dict) or not isinstance(source, dict):
        raise ExecutionError("`Object.assign` takes objects")
    return {**target, **source}


def _index_of(held: Any, value: Any = None) -> int:
    """Return the first index of an element or part of a string, -1 without."""
    if isinstance(held, str):
        return held.find(text(value))
    if isinstance(held, list):
        return next((index for index, each in enumerate(held) if _same(each, value)), -1)
    raise ExecutionError(f"`{text(held)}` has no function `indexOf`")


def _join(held: Any, separator: Any = None) -> str:
    if not isinstance(held, list):
        raise ExecutionError(f"`{text(held)}` has no function `join`")
    return joined(held, "," if separator is None else text(separator), 1)


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
    "&": _bitwise(lambda left, right: left & right),
    "|": _bitwise(lambda left, right: left | right),
    "^": _bitwise(lambda left, right: left ^ right),
    "<<": _bitwise(lambda left, right: left << (right & 31)),
    ">>": _bitwise(lambda left, right: left >> (right & 31)),
    ">>>": lambda left, right: (_bits(left) % 2**32) >> (_bits(right) & 31),
}
SIGNS: Mapping[str, Callable[[Any], Any]] = {
    "!": lambda value: not truth(value),
    "-": lambda value: whole(-number(value)),
    "+": number,
    "~": lambda value: ~_bits(value),
    "typeof": _kind,
}
FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "Math.abs": _numeric(abs),
    "Math.ceil": _numeric(math.ceil),
    "Math.floor": _numeric(math.floor),
    "Math.round": _numeric(_rounded),
    "Math.trunc": _numeric(math.trunc),
    "Math.sqrt": _numeric(math.sqrt),
    "Math.pow": _power,
    "Math.hypot": _of_reals(math.hypot),
    "Math.sin": _of_reals(math.sin),
    "Math.cos": _of_reals(math.cos),
    "Math.atan2": _of_reals(math.atan2),
    "Number": number,
    "Object.assign": _assigned,
    "Math.min": _extreme(lambda values: min(values, default=math.inf)),
    "Math.max": _extreme(lambda values: max(values, default=-math.inf)),
}
METHODS: Mapping[str, Callable[..., Any]] = {
    "concat": _concat,
    "indexOf": _index_of,
    "join": _join,
    "slice": _slice,
}
"""Functions of lists and strings; they change neither."""

_ARGUMENTS = {
    **dict.fromkeys(("Math.pow", "Math.atan2", "Object.assign"), (2, 2)),
    "indexOf": (1, 1),
    "join": (0, 1),
    "slice": (0, 2),
}
_ANY_NUMBER = ("Math.hypot", "Math.min", "Math.max", "concat")


APPLYING: Mapping[str, int] = {"every": 1, "filter": 1, "some": 1, "reduce": 2}
"""Methods of lists that take a function, with the number of its parameters."""


def apply(method: str, values: Any, function: Callable[..., Any]) -> Any:
    """Return the result of a method of a list that takes a function."""
    if not isinstance(values, list):
        raise ExecutionError(f"`{text(values)}` has no `{method}`")
    if method == "filter":
        return [each for each in values if truth(function(each))]
    if method == "reduce":
        if not values:
            raise ExecutionError("an empty list has nothing to reduce")
        return reduce(function, values)
    return (any if method == "some" else all)(truth(function(each)) for each in values)


def takes(function: str, arguments: int) -> bool:
    """Return True if a function can be called with so many arguments."""
    fewest, most = _ARGUMENTS.get(function, (1, 1))
    return function in _ANY_NUMBER or fewest <= arguments <= most
