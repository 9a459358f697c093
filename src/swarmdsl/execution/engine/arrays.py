"""Items of arrays: reading one, and arrays with one more, one less or another one.

An array never changes: another state or message may hold it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .world import ExecutionError


def item(array: Sequence[Any], number: int) -> Any:
    """Return the item with a number, counted from 0."""
    _check(array, number)
    return array[number]


def appended(array: Sequence[Any], value: Any, most: int) -> list[Any]:
    """Return the array with a value at its end; it has `most` items at most."""
    if len(array) >= most:
        raise ExecutionError(f"the array is full: it has {len(array)} items")
    return [*array, value]


def removed(array: Sequence[Any], number: int) -> list[Any]:
    """Return the array without the item with a number."""
    _check(array, number)
    after = number + 1
    return [*array[:number], *array[after:]]


def replaced(array: Sequence[Any], number: int, value: Any) -> list[Any]:
    """Return the array with another value in place of the item with a number."""
    _check(array, number)
    after = number + 1
    return [*array[:number], value, *array[after:]]


def _check(array: Sequence[Any], number: int) -> None:
    if not 0 <= number < len(array):
        raise ExecutionError(f"there is no item {number} in an array of {len(array)}")
