"""Nodes of interfaces.tx: what is exchanged, and what a robot can do."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast.nodes import Documented, TopLevel
from swarmdsl.syntax.types import Named

if TYPE_CHECKING:
    from swarmdsl.syntax.ast.nodes import Expression, TypeRef, Word


@dataclass(slots=True, eq=False)
class Field(Documented):
    """A field of a message or struct."""

    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class StructType(TopLevel):
    """`struct Pose2D { ... }`."""

    name: Word
    fields: list[Field]


@dataclass(slots=True, eq=False)
class EnumValue(Documented):
    """`NAME` or `NAME = 4`; `value` is as written, or empty."""

    name: Word
    value: str


@dataclass(slots=True, eq=False)
class EnumType(TopLevel):
    """`enum Mode : uint8 { ... }`; `type` is None until it is linked."""

    name: Word
    underlying: TypeRef | None
    values: list[EnumValue]
    type: Named | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Constant(TopLevel):
    """`const NAME : type = value`."""

    name: Word
    type: TypeRef
    value: Expression


@dataclass(slots=True, eq=False)
class AliasType(TopLevel):
    """`type Distance = float64`."""

    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class MessageType(TopLevel):
    """`message Name { ... }`; a name with `/` describes a message of another package."""

    name: Word
    constants: list[Constant]
    fields: list[Field]


@dataclass(slots=True, eq=False)
class ServiceType(TopLevel):
    """`service Name { request { ... } response { ... } }`."""

    name: Word
    request: list[Field]
    response: list[Field]


@dataclass(slots=True, eq=False)
class ActionType(TopLevel):
    """`action Name { goal { ... } result { ... } feedback { ... } }`."""

    name: Word
    goal: list[Field]
    result: list[Field]
    feedback: list[Field]


@dataclass(slots=True, eq=False)
class Event(TopLevel):
    """`event Name : Type on "topic"`; `swarm` when it travels between members."""

    swarm: bool
    name: Word
    type: TypeRef
    topic: Word | None


@dataclass(slots=True, eq=False)
class Param(Documented):
    """`param name : Type = default`."""

    name: Word
    type: TypeRef
    default: Expression | None


@dataclass(slots=True, eq=False)
class Communication(Documented):
    """`action "name" : Type` or `service "name" : Type` of a function."""

    paradigm: Literal["action", "service"]
    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class FunctionPort(Documented):
    """`in "topic" : Type` of a function."""

    direction: Literal["in", "out"]
    topic: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class Function(TopLevel):
    """`function name : abstraction { ... }`."""

    name: Word
    category: Literal["abstraction", "swarm"]
    items: list[Communication | FunctionPort | Param]
