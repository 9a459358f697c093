"""Base classes of nodes, and the leaves of the tree: words, references, types."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Generic, TypeVar

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.syntax.types import Type


class Word(str):
    """A string with its place: a name as written, or the content of a quoted string."""

    __slots__ = ("span",)
    span: Span

    def __new__(cls, text: str, span: Span) -> Word:
        """Make the word `text` at `span`."""
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
