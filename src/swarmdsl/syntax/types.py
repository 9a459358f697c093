"""Types of data: what ROS knows, by name."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.syntax.units import Unit


@dataclass(frozen=True, slots=True)
class Primitive:
    """`bool`, `int32`, `float64`, `string`, `time`, `duration`, ...

    `bound` is the greatest length of a string, None where there is no limit. In the intermediate
    representation, `enum` is the enum whose values an integer has; it makes no other type, and
    neither does `unit`, the unit of a number.
    """

    name: str
    bound: int | None = None
    enum: Named | None = field(default=None, compare=False, repr=False)
    unit: Unit | None = field(default=None, compare=False, repr=False)

    def __str__(self) -> str:
        return self.name if self.bound is None else f"{self.name}<={self.bound}"


@dataclass(frozen=True, slots=True)
class Named:
    """A message or struct; `package` is that of ROS, or of the model that defines it."""

    package: str
    name: str

    def __str__(self) -> str:
        return f"{self.package}/{self.name}"


@dataclass(frozen=True, slots=True)
class Array:
    """Many of one type: `size` of them, or up to that many if `bounded`; None for any number."""

    element: Type
    size: int | None = None
    bounded: bool = False

    def __str__(self) -> str:
        size = "" if self.size is None else str(self.size)
        return f"{self.element}[{'<=' if self.bounded else ''}{size}]"


Type = Primitive | Named | Array

INTEGERS = tuple(f"{sign}int{bits}" for bits in (8, 16, 32, 64) for sign in ("", "u"))
FLOATS = ("float32", "float64")
PRIMITIVES = ("bool", "byte", "char", *INTEGERS, *FLOATS, "string", "wstring", "time", "duration")

BOOL = Primitive("bool")
STRING = Primitive("string")
DURATION = Primitive("duration")
INT = Primitive("int64")
FLOAT = Primitive("float64")
_NUMBERS = frozenset((*INTEGERS, *FLOATS, "byte", "char"))

SELF_FIELDS = {
    "id": STRING,
    "role": STRING,
    "index": Primitive("uint32"),
    "count": Primitive("uint32"),
}
"""Fields of `self`, the robot that runs a machine."""

MEMBER = Named("swarmdsl", "Member")
"""Message of the events that heartbeats raise: the robot that joined or was lost."""

ENVELOPE_FIELDS = {"sender": STRING, "sent": DURATION}
"""Fields of `event` that every swarm event has, whatever its message."""


def unit_of(type_: Type | None) -> Unit | None:
    """Return the unit of a number, or of the numbers in an array; None for a plain number."""
    if isinstance(type_, Array):
        type_ = type_.element
    return type_.unit if isinstance(type_, Primitive) else None


def declared_unit(type_: Type | None) -> Unit | None:
    """Return the unit that a declaration gives to a number; None if it gives none."""
    unit = unit_of(type_)
    return None if unit is None or unit.is_any else unit


def unit_name(type_: Type | None) -> str | None:
    """Return the name of the unit that a declaration gives to a number; None if it gives none."""
    unit = declared_unit(type_)
    return unit.name if unit is not None else None


def with_unit(type_: Type, unit: Unit | None) -> Type:
    """Return the type of a number, or of an array of numbers, with a unit; others as they are."""
    if isinstance(type_, Array):
        return replace(type_, element=with_unit(type_.element, unit))
    if isinstance(type_, Primitive) and type_.name in _NUMBERS and type_.enum is None:
        return replace(type_, unit=unit)
    return type_


def written(type_: Type | None) -> str:
    """Return a type as it is declared, with its unit: `float64 in m`."""
    unit = declared_unit(type_)
    return f"{type_}" if unit is None else f"{type_} in {unit}"
