"""Nodes of swarm.tx: a whole file."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast.architecture import Component, Member
from swarmdsl.syntax.ast.behaviour import StateMachine
from swarmdsl.syntax.ast.composition import Environment, Fitness, Swarm
from swarmdsl.syntax.ast.interfaces import (
    ActionType,
    AliasType,
    Event,
    Function,
    MessageType,
    ServiceType,
    StructType,
)
from swarmdsl.syntax.ast.nodes import Documented, Node, Word
from swarmdsl.syntax.ast.optimization import Optimization
from swarmdsl.syntax.ast.properties import Property
from swarmdsl.syntax.ast.values import Constant, EnumType


@dataclass(slots=True, eq=False)
class Package(Documented):
    """`package name`."""

    name: Word


@dataclass(slots=True, eq=False)
class ImportFile(Documented):
    """`import "file"`."""

    path: Word


@dataclass(slots=True, eq=False)
class ImportRos(Documented):
    """`import ros "folder"`."""

    path: Word


@dataclass(slots=True, eq=False)
class ImportLibrary(Documented):
    """`import package.Name` or `import package.*`."""

    name: str


Import = ImportFile | ImportRos | ImportLibrary
Interface = StructType | EnumType | AliasType | MessageType | ServiceType | ActionType
Declaration = (
    Interface
    | Constant
    | Event
    | Function
    | Component
    | Member
    | StateMachine
    | Swarm
    | Environment
    | Fitness
    | Property
)


@dataclass(slots=True, eq=False)
class Model(Node):
    """A whole file.

    `missing_separators` are `;` or `,`, each with the span of the token that it should be before.
    """

    package: Package | None
    imports: list[Import]
    declarations: list[Declaration]
    optimizations: list[Optimization]
    missing_separators: Sequence[Word] = field(default=(), init=False, metadata={"elsewhere": True})
