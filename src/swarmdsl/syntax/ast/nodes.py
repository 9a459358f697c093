"""Base classes of nodes, and the leaves of the tree: words, references, types."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Generic, TypeVar

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.syntax.types import Type


class Word(str):
    """String with its span: a name, or the content of a string literal."""

    __slots__ = ("span",)
    span: Span

    def __new__(cls, text: str, span: Span) -> Word:
        """Make the word `text` at `span`."""
        word = super().__new__(cls, text)
        word.span = span
        return word

    # A string needs one argument.
    def __getnewargs__(self) -> tuple[str, Span]:  # type: ignore[override]
        """Return the arguments for a copy."""
        return str(self), self.span


@dataclass(slots=True, eq=False)
class Node:
    """Element of the model; `span` covers all of it, without its documentation."""

    span: Span


@dataclass(slots=True, eq=False)
class Documented(Node):
    """Node on a line of its own, which a `///` comment before it can document."""

    doc: str = field(default="", init=False)


@dataclass(slots=True, eq=False)
class TopLevel(Documented):
    """Top-level declaration of a file.

    `by_class` caches the nodes in it by their classes.
    """

    by_class: Mapping[type[Node], Sequence[Any]] | None = field(
        default=None, init=False, metadata={"elsewhere": True}
    )


N = TypeVar("N", bound=Node)


@dataclass(slots=True, eq=False)
class Ref(Generic[N]):
    """Reference to a node of class `kind` by name; `target` is None until it is linked."""

    name: str
    kind: str
    span: Span
    target: N | None = None


@dataclass(slots=True, eq=False)
class TypeRef(Node):
    """Type by name; `type` is None until it is linked, and for unknown types.

    `bound` (`<=10`) and `array` (`[]`, `[16]`, `[<=5]`) are as written, or empty; `unit` is the
    word after `in`.
    """

    name: str
    bound: str
    array: str
    unit: Word | None = None
    type: Type | None = field(default=None, init=False)
