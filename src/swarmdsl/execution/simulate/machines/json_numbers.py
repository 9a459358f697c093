"""Numbers that JSON does not have, as strings, and back."""

from __future__ import annotations

import math
from typing import Any

NOT_FINITE = ("NaN", "Infinity", "-Infinity")
"""Numbers that JSON does not have, as strings; `float` reads them."""


def named_numbers(data: Any) -> Any:
    """Replace numbers that JSON does not have by their names."""
    match data:
        case dict():
            return {key: named_numbers(value) for key, value in data.items()}
        case list() | tuple():
            return [named_numbers(value) for value in data]
        case float() if not math.isfinite(data):
            return "NaN" if math.isnan(data) else "Infinity" if data > 0 else "-Infinity"
    return data


def numbers(data: Any) -> Any:
    """Replace names of numbers by these; reverse of `named_numbers`."""
    match data:
        case dict():
            return {key: numbers(value) for key, value in data.items()}
        case list():
            return [numbers(value) for value in data]
        case str() if data in NOT_FINITE:
            return float(data)
    return data
