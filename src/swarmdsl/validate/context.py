"""What the rules share: the collector and the interfaces that the model describes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.inference import Typing, constant, fits
from swarmdsl.ir.types import Array, Named, Type
from swarmdsl.link_types import interface_name
from swarmdsl.load import Project
from swarmdsl.scopes import kind_of
from swarmdsl.source import Span
from swarmdsl.syntax import (
    Declaration,
    EventTrigger,
    Expression,
    Field,
    Interface,
    MessageType,
    Param,
    StructType,
    TypeRef,
    Variable,
    Word,
)


@dataclass(frozen=True)
class Context:
    """Passed to every rule.

    `damaged` are the declarations with a piece that could not be parsed: of what they seem
    to lack nothing can be said.
    """

    report: Diagnostics
    interfaces: dict[Named, Interface]
    typing: Typing
    damaged: set[Declaration]

    def expect(self, expression: Expression | None, wanted: Type | None, typing: Typing) -> None:
        """Check the type of an expression that could be parsed."""
        if expression is not None:
            typing.expect(expression.tree, wanted)

    def check_fits(self, found: Type | None, wanted: Type | None, at: Span) -> None:
        """Check that a value of one type can be stored as another."""
        if not fits(found, wanted):
            self.report.report("type-mismatch", at, expected=f"`{wanted}`", found=f"`{found}`")

    def check_default(self, owner: Param | Variable, value: Expression | None) -> None:
        """Check a value that must be known when the model is compiled."""
        if value is None or value.tree is None:
            return
        if not constant(value.tree):
            self.report.report("not-constant", value.span)
        self.typing.expect(value.tree, owner.type.type)

    def check_kind(self, ref: TypeRef, wanted: type[Interface]) -> None:
        """Check that a type names a message (or an action, a service), where that is known."""
        element = ref.type.element if isinstance(ref.type, Array) else ref.type
        known = self.interfaces.get(element) if isinstance(element, Named) else None
        fine = known is None if isinstance(element, Named) or ref.type is None else False
        if isinstance(known, wanted) and element is ref.type:
            fine = True
        if not fine:
            self.report.report(
                "interface-kind",
                ref.span,
                name=ref.span.text,
                actual=_kind_of_type(ref, known),
                expected=kind_of(wanted),
                related=(Label(known.name.span, "declared here"),) if known else (),
            )

    def check_repeated(self, names: Iterable[Word], what: str) -> None:
        """Report the second of two items with one name."""
        first: dict[str, Word] = {}
        for name in names:
            earlier = first.setdefault(str(name), name)
            if earlier is not name:
                self.report.report(
                    "repeated-item",
                    name.span,
                    item=f"{what} `{name}`",
                    related=(Label(earlier.span, "first given here"),),
                )

    def check_single(self, places: list[Span], what: str) -> None:
        """Report the second and later ones of something that may be given once."""
        for place in places[1:]:
            self.report.report(
                "repeated-item", place, item=what, related=(Label(places[0], "first given here"),)
            )

    def with_event(self, triggers: list[EventTrigger]) -> Typing:
        """Typing where `event` is the message of any of these triggers."""
        types = [t.event.target.type.type if t.event.target else None for t in triggers]
        alike = all(known == types[0] for known in types)
        return replace(self.typing, has_event=alike, event=types[0])


def _kind_of_type(ref: TypeRef, known: Interface | None) -> str:
    if isinstance(ref.type, Array):
        return "an array"
    return kind_of(known) if known is not None else "a primitive type"


def make_context(project: Project, report: Diagnostics) -> Context:
    """Gather the interfaces of all files."""
    interfaces: dict[Named, Interface] = {}
    messages: dict[Named, list[Field]] = {}
    damaged = {node for file in project.files for node in file.parsed.damaged}
    for file, declaration in project.declarations():
        if isinstance(declaration, Interface):
            interfaces[interface_name(file, declaration.name)] = declaration
        if isinstance(declaration, (StructType, MessageType)) and declaration not in damaged:
            messages[interface_name(file, declaration.name)] = declaration.fields
    return Context(report, interfaces, Typing(messages, report), damaged)
