"""Units of operands and results, and conversion of durations to numbers in seconds.

15 m / 3 s  -> m/s: beside a number with a unit, a duration is a number in s
m + s       -> wrong: they have different dimensions
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.syntax.ast import NEIGHBORS
from swarmdsl.syntax.types import (
    BOOL,
    DURATION,
    FLOAT,
    INT,
    STRING,
    Primitive,
    Type,
    unit_of,
    with_unit,
)
from swarmdsl.syntax.units import (
    ANY,
    DURATIONS,
    PLAIN,
    RADIAN,
    SECOND,
    UNITS,
    Dimension,
    Unit,
    unit_of_ros,
)

NUMBER_OF_SECONDS = with_unit(FLOAT, SECOND)
"""Type of a duration as a number."""

_NANOSECONDS = 10**9

_SAME = frozenset(
    ("+", "-", "%", "==", "!=", "<", "<=", ">", ">=", "min", "max", "clamp", "hypot", "atan2")
)
_KEEPING = frozenset(("+", "-", "%", "min", "max", "clamp", "hypot"))
_KEEPING_ONE = frozenset(("abs", "int", "round", "floor", "ceil", "float"))
_ANGULAR = frozenset(("sin", "cos"))
_WHOLE = {name: with_unit(INT, unit) for name, unit in UNITS.items() if unit.is_whole}
_REAL = {name: with_unit(FLOAT, unit) for name, unit in UNITS.items()}
_WITHOUT_UNIT: dict[type, Type] = {bool: BOOL, int: INT, float: FLOAT, str: STRING}


def literal_type(value: bool | int | float | str, unit: str) -> Type:
    """Return the type of a value as written with a unit, or none: a time is a duration."""
    if not unit:
        return _WITHOUT_UNIT[type(value)]
    if unit in DURATIONS:
        return DURATION
    return _WHOLE[unit] if isinstance(value, int) and unit in _WHOLE else _REAL[unit]


def of_field(type_: Type | None) -> Type | None:
    """Return the type of a value in a field: a number without a unit there may have any."""
    if type_ is None or unit_of(type_) is not None:
        return type_
    return with_unit(type_, ANY)


def has_dimension(unit: Unit | None) -> bool:
    """Return True for a unit that is not that of a plain number, and known."""
    return unit is not None and not unit.is_any and unit.dimension != PLAIN


def takes_seconds(word: str, types: Sequence[Type | None]) -> bool:
    """Return True for an operation that takes its durations as numbers in seconds."""
    if DURATION not in types:
        return False
    numbers = [each for each in types if each != DURATION]
    if not numbers or not all(isinstance(each, Primitive) for each in numbers):
        return False
    if word == "/" and types[0] != DURATION:
        return _is_number(numbers[0])
    return (word in _SAME or word in ("*", "/")) and any(
        has_dimension(unit_of(each)) for each in numbers
    )


def in_seconds(word: str, types: list[Type | None]) -> list[Type | None]:
    """Return the types of operands, durations as numbers where the operation takes them so."""
    if not takes_seconds(word, types):
        return types
    return [NUMBER_OF_SECONDS if each == DURATION else each for each in types]


def in_measure_of(other: Type | None, value: int | float, type_: Type | None) -> int | float:
    """Return a value to compare with one of another type: a duration as a number, or the reverse.

    A duration has a value in nanoseconds, a number of seconds one in seconds.
    """
    if type_ == DURATION and has_dimension(unit_of(other)):
        return value / _NANOSECONDS
    if other == DURATION and has_dimension(unit_of(type_)):
        return value * _NANOSECONDS
    return value


def result_unit(word: str, types: Sequence[Type | None]) -> Unit | None:
    """Return the unit of a number that an operation gives."""
    units = [unit_of(each) for each in types]
    match word:
        case "atan2":
            return RADIAN
        case "seconds":
            return SECOND
        case "*" | "/" | "div" | "sqrt" if any(each is not None and each.is_any for each in units):
            return ANY
        case "*":
            return unit_of_ros(_combined(units, 1))
        case "/" | "div":
            return unit_of_ros(_combined(units, -1))
        case "sqrt":
            return unit_of_ros(_halved(_dimension(units[0]))) if has_root(units[0]) else ANY
        case "-" | "+" | "abs" | "%" if len(units) == 1:
            return units[0]
    if word in _KEEPING or word in _KEEPING_ONE:
        known = [each for each in units if each is not None]
        return next((each for each in known if not each.is_any), known[0] if known else None)
    return None


def must_be_alike(word: str) -> bool:
    """Return True for an operation on numbers of one unit."""
    return word in _SAME


def taken_unit(word: str) -> Unit | None:
    """Return the unit of what a function takes, if it takes no other one."""
    return RADIAN if word in _ANGULAR else UNITS["m"] if word == NEIGHBORS else None


def units_fit(found: Unit | None, expected: Unit | None) -> bool:
    """Return True if a number of one unit can be used where the other is expected."""
    if (found is not None and found.is_any) or (expected is not None and expected.is_any):
        return True
    return _dimension(found) == _dimension(expected)


def has_root(unit: Unit | None) -> bool:
    """Return True for the unit of a square."""
    return all(count % 2 == 0 for count in _dimension(unit))


def _is_number(type_: Type | None) -> bool:
    return isinstance(type_, Primitive) and (
        type_.name in ("float32", "float64", "byte", "char") or "int" in type_.name
    )


def _dimension(unit: Unit | None) -> Dimension:
    return PLAIN if unit is None else unit.dimension


def _combined(units: Sequence[Unit | None], sign: int) -> Dimension:
    left, right = map(_dimension, units)
    return _as_dimension([one + sign * other for one, other in zip(left, right, strict=True)])


def _halved(dimension: Dimension) -> Dimension:
    return _as_dimension([count // 2 for count in dimension])


def _as_dimension(counts: list[int]) -> Dimension:
    length, angle, time, mass, current, heat = counts
    return length, angle, time, mass, current, heat
