"""Types of data: what ROS knows, by name."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field


@dataclass(frozen=True, slots=True)
class Primitive:
    """`bool`, `int32`, `float64`, `string`, `time`, `duration`, ...

    `bound` is the greatest length of a string, None where there is no limit. In the intermediate
    representation, `enum` is the enum whose values an integer has; it makes no other type.
    """

    name: str
    bound: int | None = None
    enum: Named | None = field(default=None, compare=False, repr=False)

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

SELF_FIELDS = {
    "id": STRING,
    "role": STRING,
    "index": Primitive("uint32"),
    "count": Primitive("uint32"),
}
"""Fields of `self`, the robot that runs a machine."""

ENVELOPE_FIELDS = {"sender": STRING, "sent": DURATION}
"""Fields of `event` that every swarm event has, whatever its message."""
