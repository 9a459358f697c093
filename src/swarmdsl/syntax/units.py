"""Units of numbers: their dimensions, and their factors to the units of ROS (REP 103).

    15 m, 0.1 km   -> 15, 100.0, both of dimension length
    36 km/h        -> 10.0, of dimension length / time
    20 %           -> 0.2, a plain number

Values are numbers in the units of ROS everywhere else: metres, radians, seconds, kilograms,
amperes, degrees Celsius, and what is derived from them.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, pi

from swarmdsl.base.records import dataclass

# Exponents of length, angle, time, mass, current and temperature.
Dimension = tuple[int, int, int, int, int, int]
_BASE = ("m", "rad", "s", "kg", "A", "degC")
# Their order in the name of a product.
_AS_NAMED = ("kg", "A", "m", "rad", "s", "degC")
PLAIN: Dimension = (0, 0, 0, 0, 0, 0)


@dataclass(frozen=True, slots=True)
class Unit:
    """Unit with the factor to that of ROS as a fraction.

    `is_any` is set for a number whose unit is not known: it fits every unit.
    """

    name: str
    dimension: Dimension
    numerator: int | float = 1
    denominator: int = 1
    is_any: bool = False

    @property
    def is_whole(self) -> bool:
        """True if a whole number in this unit is whole in the unit of ROS, too."""
        return self.denominator == 1

    def __str__(self) -> str:
        return self.name


ANY = Unit("", PLAIN, is_any=True)
"""Unit of a field that declares none: it is a number of ROS, of whatever unit."""

_LENGTH, _ANGLE, _TIME = (1, 0, 0, 0, 0, 0), (0, 1, 0, 0, 0, 0), (0, 0, 1, 0, 0, 0)
_MASS, _CURRENT, _HEAT = (0, 0, 0, 1, 0, 0), (0, 0, 0, 0, 1, 0), (0, 0, 0, 0, 0, 1)
_SPEED, _ACCELERATION = (1, 0, -1, 0, 0, 0), (1, 0, -2, 0, 0, 0)
_TURN, _TURN_CHANGE = (0, 1, -1, 0, 0, 0), (0, 1, -2, 0, 0, 0)
_ENERGY, _POWER = (2, 0, -2, 1, 0, 0), (2, 0, -3, 1, 0, 0)
_VOLTAGE, _CHARGE = (2, 0, -3, 1, -1, 0), (0, 0, 1, 0, 1, 0)

_TABLE: tuple[tuple[str, Dimension, int | float, int], ...] = (
    ("m", _LENGTH, 1, 1),
    ("km", _LENGTH, 1000, 1),
    ("cm", _LENGTH, 1, 100),
    ("mm", _LENGTH, 1, 1000),
    ("m2", (2, 0, 0, 0, 0, 0), 1, 1),
    ("m3", (3, 0, 0, 0, 0, 0), 1, 1),
    ("rad", _ANGLE, 1, 1),
    ("deg", _ANGLE, pi, 180),
    ("s", _TIME, 1, 1),
    ("us", _TIME, 1, 1_000_000),
    ("ms", _TIME, 1, 1000),
    ("min", _TIME, 60, 1),
    ("h", _TIME, 3600, 1),
    ("m/s", _SPEED, 1, 1),
    ("km/h", _SPEED, 5, 18),
    ("m/s2", _ACCELERATION, 1, 1),
    ("rad/s", _TURN, 1, 1),
    ("deg/s", _TURN, pi, 180),
    ("rad/s2", _TURN_CHANGE, 1, 1),
    ("Hz", (0, 0, -1, 0, 0, 0), 1, 1),
    ("kg", _MASS, 1, 1),
    ("g", _MASS, 1, 1000),
    ("N", (1, 0, -2, 1, 0, 0), 1, 1),
    ("J", _ENERGY, 1, 1),
    ("Wh", _ENERGY, 3600, 1),
    ("kWh", _ENERGY, 3_600_000, 1),
    ("W", _POWER, 1, 1),
    ("kW", _POWER, 1000, 1),
    ("V", _VOLTAGE, 1, 1),
    ("mV", _VOLTAGE, 1, 1000),
    ("A", _CURRENT, 1, 1),
    ("mA", _CURRENT, 1, 1000),
    ("Ah", _CHARGE, 3600, 1),
    ("mAh", _CHARGE, 18, 5),
    ("degC", _HEAT, 1, 1),
    ("%", PLAIN, 1, 100),
)
UNITS: Mapping[str, Unit] = {row[0]: Unit(*row) for row in _TABLE}

PERCENT = UNITS["%"]
SECOND = UNITS["s"]
RADIAN = UNITS["rad"]
DURATIONS = ("us", "ms", "s", "min", "h")
"""Units with which a number is a duration."""

_OF_ROS = {
    unit.dimension: unit for unit in UNITS.values() if (unit.numerator, unit.denominator) == (1, 1)
}
# What people write for a unit.
_OTHER_NAMES = {
    **dict.fromkeys(("metre", "metres", "meter", "meters"), "m"),
    **dict.fromkeys(("radian", "radians"), "rad"),
    **dict.fromkeys(("degree", "degrees", "\N{DEGREE SIGN}"), "deg"),
    **dict.fromkeys(("sec", "secs", "second", "seconds"), "s"),
    **dict.fromkeys(("minute", "minutes"), "min"),
    **dict.fromkeys(("hour", "hours", "hr"), "h"),
    **dict.fromkeys(("mps", "meters_per_second"), "m/s"),
    **dict.fromkeys(("kmh", "kph", "km/hr"), "km/h"),
    **dict.fromkeys(("percent", "pct"), "%"),
    **dict.fromkeys(("hertz", "hz"), "Hz"),
    **dict.fromkeys(("celsius", "C"), "degC"),
    **dict.fromkeys(("volt", "volts"), "V"),
    **dict.fromkeys(("watt", "watts"), "W"),
    **dict.fromkeys(("kilogram", "kilograms"), "kg"),
}


def unit_of_ros(dimension: Dimension) -> Unit | None:
    """Return the unit in which ROS has numbers of a dimension; None for plain numbers."""
    if dimension == PLAIN:
        return None
    known = _OF_ROS.get(dimension)
    return known if known is not None else Unit(_product(dimension), dimension)


def _product(dimension: Dimension) -> str:
    """Return the name of a unit without a name of its own: `m2/s`."""
    counts = dict(zip(_BASE, dimension, strict=True))
    above = [_power(name, counts[name]) for name in _AS_NAMED if counts[name] > 0]
    below = [_power(name, -counts[name]) for name in _AS_NAMED if counts[name] < 0]
    return "/".join([" ".join(above) or "1", *below])


def _power(name: str, count: int) -> str:
    return name if count == 1 else f"{name}{count}"


def in_unit_of_ros(digits: str, unit: Unit) -> int | float:
    """Convert a number as written; one that is too large is infinite.

    Decimal fractions are converted exactly and rounded once: `0.3 cm` is 0.003.
    """
    if unit.is_whole and digits.isdecimal():
        return int(digits) * int(unit.numerator)
    if isinstance(unit.numerator, float):
        return float(digits) * (unit.numerator / unit.denominator)
    from fractions import Fraction

    try:
        return float(Fraction(digits) * unit.numerator / unit.denominator)
    except OverflowError:
        return inf


def written_in(value: int | float, unit: Unit) -> str:
    """Return a value of ROS as a number with a unit that reads as exactly this value."""
    from fractions import Fraction

    places = ((each, count) for each in (unit, unit_of_ros(unit.dimension)) for count in (15, 17))
    for each, count in places:
        if each is None or each.name not in UNITS:
            continue
        if isinstance(each.numerator, float):
            number = value / (each.numerator / each.denominator)
        else:
            number = float(Fraction(value) * each.denominator / each.numerator)
        number = float(f"{number:.{count}g}")
        digits = str(int(number)) if number.is_integer() and abs(number) < 1e15 else repr(number)
        if isinstance(value, float) and each.is_whole and digits.lstrip("-").isdecimal():
            digits += ".0"  # it stays a floating-point number
        if in_unit_of_ros(digits.lstrip("-"), each) == abs(value):
            return f"{digits} {each}"
    of_ros = unit_of_ros(unit.dimension)
    factors = [f"1 {name}" for name in of_ros.name.split(" ")] if of_ros is not None else ["100 %"]
    return f"({' * '.join([repr(value), *factors])})"


def described_unit(unit: Unit) -> str:
    """Return a sentence that says in which unit ROS has numbers of a declared unit."""
    of_ros = unit_of_ros(unit.dimension)
    return f"In {of_ros}." if of_ros is not None else "A share of 1: 0.2 is 20 %."


def meant_unit(name: str) -> str | None:
    """Return the unit that another name or spelling of one means."""
    if name in _OTHER_NAMES:
        return _OTHER_NAMES[name]
    folded = {known.lower(): known for known in UNITS}
    return folded.get(name.lower())
