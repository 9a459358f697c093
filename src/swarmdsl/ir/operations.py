"""Operators and built-in functions of the language as functions of values."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping

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
}
"""All but `and`, `or` and `not`, which each caller evaluates itself."""
