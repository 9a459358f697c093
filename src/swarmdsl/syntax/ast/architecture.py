"""Nodes of architecture.tx: components, and members built from them."""

from __future__ import annotations

from typing import Literal

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast.behaviour import EventTrigger, StateMachine, Vertex
from swarmdsl.syntax.ast.interfaces import Function, Operation
from swarmdsl.syntax.ast.nodes import Documented, Node, Ref, TopLevel, TypeRef, Word
from swarmdsl.syntax.ast.space import Equipment, Sight
from swarmdsl.syntax.ast.values import Expression, Param, PartValue


@dataclass(slots=True, eq=False)
class Port(Documented):
    """`out name : Type on "topic"`."""

    direction: Literal["in", "out", "inout"]
    name: Word
    type: TypeRef
    topic: Word | None


@dataclass(slots=True, eq=False)
class Component(TopLevel):
    """`sensor Name { ... }` and the other kinds."""

    kind: Literal["sensor", "actuator", "controller", "virtual"]
    name: Word
    base: Ref[Component] | None
    items: list[Port | Param | Operation | BehaviorUse | Sight]


@dataclass(slots=True, eq=False)
class BehaviorUse(Documented):
    """`behavior Machine`."""

    machine: Ref[StateMachine]


@dataclass(slots=True, eq=False)
class CommunicationSettings(Documented):
    """`communication zyre { ifname = "eth0" }`."""

    technology: Word
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class Part(Documented):
    """`name : Component { ... }`."""

    name: Word
    component: Ref[Component]
    values: list[PartValue]


@dataclass(slots=True, eq=False)
class PortRef(Node):
    """`part.port`, or `port` of the member itself."""

    part: Ref[Part] | None
    port: Ref[Port]


@dataclass(slots=True, eq=False)
class Connector(Documented):
    """`connect source -> target`."""

    source: PortRef
    target: PortRef


@dataclass(slots=True, eq=False)
class SafeState(Node):
    """State that a contract leads to."""

    state: Ref[Vertex]


@dataclass(slots=True, eq=False)
class Contract(Documented):
    """`contract Name : on Abort within 2 s reach Landed`, or `... : when dead call land`."""

    name: Word
    triggers: list[EventTrigger]
    guard: Expression | None
    within: Expression | None
    states: list[SafeState]
    function: Ref[Function] | None


@dataclass(slots=True, eq=False)
class Member(TopLevel):
    """`member Name { ... }`."""

    name: Word
    base: Ref[Member] | None
    items: list[
        BehaviorUse | CommunicationSettings | Equipment | Port | Param | Connector | Contract | Part
    ]
