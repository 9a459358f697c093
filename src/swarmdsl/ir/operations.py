"""Operators and built-in functions of the language as functions of values."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping

SECOND = 10**9
"""Length of a second as a duration."""


def _distance(*coordinates: float) -> float:
    """Return the distance of two points: the coordinates of one, then those of the other."""
    count = len(coordinates) // 2
    return math.hypot(*map(operator.sub, coordinates[:count], coordinates[count:]))


OPERATIONS: Mapping[str, Callable[..., bool | int | float | str]] = {
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
    "contains": operator.contains,
    "div": operator.floordiv,
    "int": int,
    "float": float,
    "round": round,
    "floor": math.floor,
    "ceil": math.ceil,
    "clamp": lambda value, low, high: min(max(value, low), high),
    "hypot": math.hypot,
    "seconds": lambda length: length / SECOND,
    "sin": math.sin,
    "cos": math.cos,
    # An integer has no negative zero in Python, but has one in ECMAScript.
    "atan2": lambda y, x: math.atan2(y + 0.0, x + 0.0),
    "distance": _distance,
}
"""All but `and`, `or` and `not`, which each caller evaluates itself."""
