"""Nodes of interfaces.tx: types, interfaces, events, functions, and operations of components."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast.nodes import Documented, TopLevel, TypeRef, Word
from swarmdsl.syntax.ast.space import ModelUse
from swarmdsl.syntax.ast.values import Constant, Expression, Field, Param


@dataclass(slots=True, eq=False)
class StructType(TopLevel):
    """`struct Pose2D { ... }`."""

    name: Word
    fields: list[Field]


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
class DeliverySetting(Documented):
    """`reliable`, `best effort`, `latest`, `keep 5`, `lifespan 5 s` or `deadline 1 s`.

    The last three have a value.
    """

    kind: Literal["reliable", "best", "latest", "keep", "lifespan", "deadline"]
    value: Expression | None


@dataclass(slots=True, eq=False)
class Event(TopLevel):
    """`swarm operator event Name : Type on "topic" { ... }`.

    `swarm` when it travels between members, `operator` when a person may send it.
    """

    swarm: bool
    operator: bool
    name: Word
    type: TypeRef
    topic: Word | None
    delivery: list[DeliverySetting]


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
    items: list[Communication | FunctionPort | Param | ModelUse]


@dataclass(slots=True, eq=False)
class Parameter(Documented):
    """`in name : Type` of an operation; `direction` is empty where none is written."""

    direction: Literal["in", "out", ""]
    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class Operation(Documented):
    """`operation name(in x : Type, out y : Type)` of a component."""

    name: Word
    parameters: list[Parameter]
