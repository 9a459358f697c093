"""Expressions, and the declarations whose values they name: constants, params, variables, ..."""

from __future__ import annotations

from typing import Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast.nodes import Documented, Node, Ref, TopLevel, TypeRef, Word
from swarmdsl.syntax.types import Named


@dataclass(slots=True, eq=False)
class Expression(Node):
    """Expression as in expression.lark; `tree` is None if it has an error."""

    tree: ExpressionTree | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Value(Node):
    """Number, string or boolean; `unit` as written, or empty."""

    value: bool | int | float | str
    unit: str = ""


@dataclass(slots=True, eq=False)
class NameUse(Node):
    """Name of a value, or of an enum before one of its values.

    `event` and `self` are names too; nothing declares them. A field is one of the goal of a
    function, in the arguments of its model.
    """

    name: str
    target: Variable | Param | Constant | EnumType | Input | Element | Field | None = field(
        default=None, init=False, metadata={"elsewhere": True}
    )

    @property
    def is_predefined(self) -> bool:
        """True for a name that every machine has without a declaration."""
        return self.name in ("event", "self")


@dataclass(slots=True, eq=False)
class FieldUse(Node):
    """`base.name`."""

    base: ExpressionTree
    name: Word


@dataclass(slots=True, eq=False)
class IndexUse(Node):
    """`base[index]`, an item of an array, or one robot of a role."""

    base: ExpressionTree
    index: ExpressionTree


@dataclass(slots=True, eq=False)
class Element(Node):
    """`name in array`: the name of each item in a query."""

    name: Word
    array: ExpressionTree


@dataclass(slots=True, eq=False)
class Query(Node):
    """`function(element in array where condition by key)`, the function a built-in one."""

    function: Word
    element: Element
    condition: ExpressionTree | None
    key: ExpressionTree | None


@dataclass(slots=True, eq=False)
class FieldValue(Node):
    """`name = value` in a construction."""

    name: Word
    value: ExpressionTree


@dataclass(slots=True, eq=False)
class Construction(Node):
    """`Type(field = value)`: a new message."""

    type: TypeRef
    values: tuple[FieldValue, ...]


@dataclass(slots=True, eq=False)
class InState(Node):
    """`in(state)`: true while a state of the machine is active.

    `known` is its value in a guard where it is always the same.
    """

    state: Ref[Any]  # a state, whose class is in a module that imports this one
    known: bool | None = field(default=None, init=False, metadata={"elsewhere": True})


@dataclass(slots=True, eq=False)
class Elapsed(Node):
    """`elapsed(state)`: for how long a state around the expression has been active.

    Without `state`, it is the innermost one; `owner` is the state that is meant.
    """

    function: Word
    state: Ref[Any] | None
    owner: Any = field(default=None, init=False, metadata={"elsewhere": True})


NEIGHBORS = "neighbors within"
"""Function of `neighbors within distance`, which is a call of it; no call can name it."""


@dataclass(slots=True, eq=False)
class Call(Node):
    """`function(arguments)`, the function a built-in one."""

    function: Word
    arguments: tuple[ExpressionTree, ...]


@dataclass(slots=True, eq=False)
class RoleUse(Node):
    """Name of a role in `present(role)`; each swarm that runs the machine has its own."""

    name: str


@dataclass(slots=True, eq=False)
class OperatorUse(Node):
    """An operator with one or two operands."""

    operator: Word
    operands: tuple[ExpressionTree, ...]


ExpressionTree = (
    Value
    | NameUse
    | RoleUse
    | FieldUse
    | IndexUse
    | InState
    | Elapsed
    | Call
    | Query
    | Construction
    | OperatorUse
)


@dataclass(slots=True, eq=False)
class Constant(TopLevel):
    """`const NAME : type = value`."""

    name: Word
    type: TypeRef
    value: Expression


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
class Field(Documented):
    """A field of a message or struct."""

    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class Param(Documented):
    """`param name : Type = default`."""

    name: Word
    type: TypeRef
    default: Expression | None


@dataclass(slots=True, eq=False)
class Variable(Documented):
    """`var name : Type = initial`."""

    name: Word
    type: TypeRef
    initial: Expression | None


@dataclass(slots=True, eq=False)
class Input(Documented):
    """`in name : Type` of a fitness."""

    name: Word
    type: TypeRef


@dataclass(slots=True, eq=False)
class PartValue(Documented):
    """`name = value` in a part, a role or a robot of a role."""

    name: Word
    value: Expression


@dataclass(slots=True, eq=False)
class Argument(Node):
    """`name = value` in a call or a send."""

    name: Word
    value: Expression
