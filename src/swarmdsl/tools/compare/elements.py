"""A model as a tree of what has a name in it, each with what is said of it in words."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.base.source import Span
from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.ir import Expression, Type


@dataclass(frozen=True, slots=True)
class Ref:
    """Something else of the model that is named: its kind, and its name among those."""

    kind: str
    name: str


Value = tuple["str | Ref", ...]
"""What is said of something: text with names in it, which may change without the rest."""


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """Something in a model.

    `kind` is the word that a person has for it, `name` is unique among its kind beside it; what
    has no name of its own, as a transition, is called by what it is for. `values` are what is
    said of it, by words; one that is empty is not said. `ref` is how others refer to it.
    """

    kind: str
    name: Value
    values: tuple[tuple[str, Value], ...] = ()
    children: tuple[Element, ...] = ()
    ref: Ref | None = None
    origin: Span | None = field(default=None, repr=False)

    def walk(self) -> Iterator[Element]:
        """Yield it and all in it."""
        yield self
        for child in self.children:
            yield from child.walk()


def said(**values: object) -> tuple[tuple[str, Value], ...]:
    """Values by their words, `_` for a blank; a value that is nothing is left out."""
    return tuple(
        (word.replace("_", " "), made)
        for word, value in values.items()
        if (made := value if isinstance(value, tuple) else text(value))
    )


def text(value: object) -> Value:
    """A value without names; nothing for False, None and empty text."""
    if value is True:
        return ("yes",)
    return (str(value),) if value not in (False, None, "") else ()


def joined(values: Iterable[Value], between: str) -> Value:
    """Several values with something between them."""
    found: list[str | Ref] = []
    for value in values:
        if found:
            found.append(between)
        found += value
    return tuple(found)


def written(value: Expression | None, machine: str = "") -> Value:
    """An expression as the language writes it; variables and params are those of a machine."""
    if value is None:
        return ()
    if not machine:
        return (expression(value),)
    pieces = expression(value, f"{_MARK}{{}}{_MARK}".format).split(_MARK)
    # Every second one is a name.
    kind = data_of(machine)
    return tuple(
        Ref(kind, piece) if index % 2 else piece for index, piece in enumerate(pieces) if piece
    )


def assigned(
    values: Iterable[tuple[str, Expression]], machine: str = "", between: str = ", "
) -> Value:
    """Values by name, as arguments are written."""
    return joined(((f"{name} = ", *written(value, machine)) for name, value in values), between)


def type_of(type_: Type | None) -> Value:
    """A type; the name of an interface is that of something in the model."""
    if type_ is None:
        return ()
    whole = str(type_)
    name, bracket, size = whole.partition("[")
    return (Ref("interface", name), f"{bracket}{size}") if "/" in name else (whole,)


def state_of(machine: str) -> str:
    """The kind of a machine's states."""
    return f"state of {machine}"


def data_of(machine: str) -> str:
    """The kind of a machine's variables and params."""
    return f"variable of {machine}"


def with_doc(element: Element, doc: str) -> Element:
    """The element with what is said of it in a comment."""
    if not doc:
        return element
    return replace(element, values=(*element.values, (DOC, (" ".join(doc.split()),))))


DOC = "documentation"
# No text of a model has it.
_MARK = "\0"
