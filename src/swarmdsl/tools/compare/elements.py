"""Tree of the elements of a model with their properties."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.base.source import Span
from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.ir import Docs, Expression, Type
from swarmdsl.syntax.types import written


@dataclass(frozen=True, slots=True)
class Ref:
    """Reference to another element of the model; `name` is unique within `kind`."""

    kind: str
    name: str


Value = tuple["str | Ref", ...]
"""Strings and references; renaming an element does not change a value."""


@dataclass(frozen=True, slots=True, eq=False)
class Element:
    """Element of a model.

    `kind` is the keyword of the language. `name` is unique among siblings of one kind; an element
    without a name, such as a transition, is named by its triggers. `values` are the properties;
    empty ones are left out. `ref` is how other elements refer to it. `places` are the places of
    those properties that have their own.
    """

    kind: str
    name: Value
    values: tuple[tuple[str, Value], ...] = ()
    children: tuple[Element, ...] = ()
    ref: Ref | None = None
    origin: Span | None = field(default=None, repr=False)
    places: tuple[tuple[str, Span | None], ...] = ()

    def walk(self) -> Iterator[Element]:
        """Yield the element and all its descendants."""
        yield self
        for child in self.children:
            yield from child.walk()

    def place(self, property_name: str) -> Span | None:
        """Place of a property; without one of its own, that of the element."""
        return dict(self.places).get(property_name) or self.origin


def reference(name: str | None, kind: str) -> Value:
    """Return a reference as a value; an empty value without a name."""
    return (Ref(kind, name),) if name is not None else ()


def properties(**values: object) -> tuple[tuple[str, Value], ...]:
    """Properties by name, with `_` for a blank; empty values are left out."""
    return tuple(
        (name.replace("_", " "), made)
        for name, value in values.items()
        if (made := value if isinstance(value, tuple) else plain_value(value))
    )


def plain_value(value: object) -> Value:
    """Value without references; empty for False, None and ""."""
    if value is True:
        return ("yes",)
    return (str(value),) if value not in (False, None, "") else ()


def join_values(values: Iterable[Value], between: str) -> Value:
    """Join values with a separator."""
    found: list[str | Ref] = []
    for value in values:
        if found:
            found.append(between)
        found += value
    return tuple(found)


def expression_value(value: Expression | None, machine: str = "") -> Value:
    """Expression as `.swarm` text; variables and params refer to `machine`."""
    if value is None:
        return ()
    if not machine:
        return (expression(value),)
    pieces = expression(value, f"{_MARK}{{}}{_MARK}".format).split(_MARK)
    # Marks surround names, so that every second piece is one.
    kind = variable_kind(machine)
    return tuple(
        Ref(kind, piece) if index % 2 else piece for index, piece in enumerate(pieces) if piece
    )


def argument_values(
    values: Iterable[tuple[str, Expression]], machine: str = "", between: str = ", "
) -> Value:
    """Named values in the form of arguments: `a = 1, b = 2`."""
    return join_values(
        ((f"{name} = ", *expression_value(value, machine)) for name, value in values), between
    )


def type_value(type_: Type | None) -> Value:
    """Type as a value; an interface becomes a reference."""
    if type_ is None:
        return ()
    whole = str(type_)
    name, bracket, size = whole.partition("[")
    return (Ref("interface", name), f"{bracket}{size}") if "/" in name else (written(type_),)


def with_names(element: Element, names: Mapping[Ref, Ref]) -> Element:
    """Return an element in which some elements have other names."""
    if not names:
        return element

    def value(given: Value) -> Value:
        return tuple(names.get(each, each) if isinstance(each, Ref) else each for each in given)

    return replace(
        element,
        name=value(element.name),
        values=tuple((name, value(given)) for name, given in element.values),
        children=tuple(with_names(child, names) for child in element.children),
        ref=names.get(element.ref, element.ref) if element.ref is not None else None,
    )


def state_kind(machine: str) -> str:
    """Return the reference kind of the states of a machine."""
    return f"state of {machine}"


def role_kind(swarm: str) -> str:
    """Return the reference kind of the roles of a swarm."""
    return f"role of {swarm}"


def variable_kind(machine: str) -> str:
    """Return the reference kind of the variables and params of a machine."""
    return f"variable of {machine}"


def with_doc(element: Element, doc: str, lines: Docs = ()) -> Element:
    """Return the element with its doc comments, and those of single lines in it, as properties."""
    found = [(DOC, doc), *((f"{DOC} of {name}", text) for name, text in lines)]
    values = tuple((name, (" ".join(text.split()),)) for name, text in found if text)
    return replace(element, values=(*element.values, *values)) if values else element


DOC = "documentation"
ROBOT_KIND = "robot"
# A character that models cannot contain.
_MARK = "\0"
