"""What all nodes are made of: words with places, references, types, expressions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.syntax.types import Type

if TYPE_CHECKING:
    from swarmdsl.syntax.ast.behaviour import Variable
    from swarmdsl.syntax.ast.composition import FitnessInput
    from swarmdsl.syntax.ast.interfaces import Constant, EnumType, Param


class Word(str):
    """A piece of text with its place: a name as written, or the content of a quoted text."""

    __slots__ = ("span",)
    span: Span

    def __new__(cls, text: str, span: Span) -> Word:
        """Make the word `text` that stands at `span`."""
        word = super().__new__(cls, text)
        word.span = span
        return word


@dataclass(slots=True, eq=False)
class Node:
    """A piece of the model; `span` covers all of it, without its documentation."""

    span: Span


@dataclass(slots=True, eq=False)
class Documented(Node):
    """A node that a `///` comment before it documents: whatever stands on a line of its own."""

    doc: str = field(default="", init=False)


@dataclass(slots=True, eq=False)
class TopLevel(Documented):
    """A declaration of a file.

    `by_class` are it and all inside it by their classes, once somebody asked.
    """

    by_class: Mapping[type[Node], Sequence[Any]] | None = field(
        default=None, init=False, metadata={"elsewhere": True}
    )


N = TypeVar("N", bound=Node)


@dataclass(slots=True, eq=False)
class Ref(Generic[N]):
    """A name that refers to a node of class `kind`; `target` is None until it is linked."""

    name: str
    kind: str
    span: Span
    target: N | None = None


@dataclass(slots=True, eq=False)
class TypeRef(Node):
    """A type by name; `type` is None until it is linked, and after, if there is none.

    `bound` (`<=10`) and `array` (`[]`, `[16]`, `[<=5]`) are as written, or empty.
    """

    name: str
    bound: str
    array: str
    type: Type | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Expression(Node):
    """An expression of the small language in expression.lark; `tree` is None if it is wrong."""

    tree: ExpressionTree | None = field(default=None, init=False)


@dataclass(slots=True, eq=False)
class Value(Node):
    """A number, text or truth value; `unit` as written, or empty."""

    value: bool | int | float | str
    unit: str = ""


@dataclass(slots=True, eq=False)
class NameUse(Node):
    """The name of a value, or of an enum before one of its; `event` is a name of its own."""

    name: str
    target: Variable | Param | Constant | EnumType | FitnessInput | None = field(
        default=None, init=False, metadata={"elsewhere": True}
    )


@dataclass(slots=True, eq=False)
class FieldUse(Node):
    """`base.name`."""

    base: ExpressionTree
    name: Word


@dataclass(slots=True, eq=False)
class Call(Node):
    """`function(arguments)`, the function a built-in one."""

    function: Word
    arguments: tuple[ExpressionTree, ...]


@dataclass(slots=True, eq=False)
class OperatorUse(Node):
    """An operator with one or two operands."""

    operator: Word
    operands: tuple[ExpressionTree, ...]


ExpressionTree = Value | NameUse | FieldUse | Call | OperatorUse
