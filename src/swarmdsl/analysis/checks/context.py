"""What the rules share: the collector and the interfaces that the model describes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.analysis.checks.state_hierarchy import Outline
from swarmdsl.analysis.node_kinds import kind_of
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types import Typing, constant, fits, is_number
from swarmdsl.analysis.usage import UsesOfAll
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.project.loader import Project
from swarmdsl.project.rosidl.interface_file import INTERFACE_KINDS
from swarmdsl.syntax.ast import (
    Branch,
    Declaration,
    EnumType,
    EventTrigger,
    Expression,
    ImportRos,
    Interface,
    MessageType,
    MonitorTrigger,
    Param,
    StateMachine,
    StructType,
    TopLevel,
    Transition,
    TypeRef,
    Variable,
    Word,
)
from swarmdsl.syntax.types import Array, Named, Type

if TYPE_CHECKING:
    from swarmdsl.analysis.checks.events import Exchange
    from swarmdsl.analysis.checks.guard_satisfiability import Condition
    from swarmdsl.analysis.checks.submachines import Reuse


@dataclass
class Known:
    """What is known of single declarations by the rules about all together.

    It holds for the next check too: a declaration that changed, or that uses one that did, is
    another node then.
    """

    reuse: Mapping[StateMachine, Reuse] = field(default_factory=dict)
    exchanges: Mapping[Declaration | None, Exchange] = field(default_factory=dict)
    uses: UsesOfAll = field(default_factory=UsesOfAll)


@dataclass(frozen=True)
class Context:
    """Passed to every rule.

    `damaged` are the declarations with a piece that could not be parsed: of what they seem
    to lack nothing can be said. What was found of guards and machines is kept: `conditions`,
    which of them are `certain`, `outlines`; and what is `known` from earlier checks.
    """

    report: Diagnostics
    interfaces: Interfaces
    typing: Typing
    damaged: set[TopLevel]
    known: Known
    conditions: dict[Transition | Branch, Condition] = field(default_factory=dict)
    certain: dict[Transition | Branch, bool | None] = field(default_factory=dict)
    outlines: dict[StateMachine, Outline] = field(default_factory=dict)

    def reporting_to(self, report: Diagnostics) -> Context:
        """The same with another collector."""
        return replace(self, report=report, typing=replace(self.typing, report=report))

    def outline(self, machine: StateMachine) -> Outline:
        """Which states of a machine are in which."""
        if machine not in self.outlines:
            self.outlines[machine] = Outline(machine)
        return self.outlines[machine]

    def forget(self, declaration: Declaration) -> None:
        """Give back what was kept for a declaration that all rules have looked at."""
        if isinstance(declaration, StateMachine):
            self.outlines.pop(declaration, None)
            self.conditions.clear()
            self.certain.clear()

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
        if value is not None:
            self.check_constant(value, owner.type.type)

    def check_constant(self, value: Expression, wanted: Type | None) -> None:
        """Check a value of a type that must be known when the model is compiled."""
        if value.tree is None:
            return
        if not constant(value.tree):
            self.report.report("not-constant", value.span)
        self.typing.expect(value.tree, wanted)

    def check_number(self, value: Expression) -> None:
        """Check that a value is a number."""
        if value.tree is None:
            return
        found = self.typing.infer(value.tree)
        if found is not None and not is_number(found):
            self.report.report("type-mismatch", value.span, expected="a number", found=f"`{found}`")

    def check_kind(self, ref: TypeRef, wanted: type[Interface]) -> None:
        """Check that a type names a message (or an action, a service), where that is known."""
        element = ref.type.element if isinstance(ref.type, Array) else ref.type
        known = self.interfaces.get(element, wanted) if isinstance(element, Named) else None
        unknown = isinstance(element, Named) and known is None
        # A struct is a message that the model defines.
        kinds = (MessageType, StructType) if wanted is MessageType else wanted
        fine = element is ref.type and (unknown or isinstance(known, kinds))
        if ref.type is not None and not fine:
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

    def report_unknown_param(self, name: Word, owner: str, params: Iterable[str]) -> None:
        """Report a value for a param that its owner does not have."""
        hints = self.report.wants_hint("unknown-param")
        help_ = suggest(name, params, "params") if hints else None
        self.report.report("unknown-param", name.span, owner=owner, name=name, help=help_)

    def check_single(self, places: list[Span], what: str) -> None:
        """Report the second and later ones of something that may be given once."""
        for place in places[1:]:
            self.report.report(
                "repeated-item", place, item=what, related=(Label(places[0], "first given here"),)
            )

    def with_event(self, triggers: list[EventTrigger | MonitorTrigger]) -> Typing:
        """Typing where `event` is the message of any of these triggers."""
        types = [_message(trigger) for trigger in triggers]
        alike = all(known == types[0] for known in types)
        return self.typing.on_event(types[0], known=alike)


def _message(trigger: EventTrigger | MonitorTrigger) -> Type | None:
    if isinstance(trigger, MonitorTrigger):
        return trigger.type.type
    return trigger.event.target.type.type if trigger.event.target is not None else None


def _kind_of_type(ref: TypeRef, known: Interface | None) -> str:
    if isinstance(ref.type, Array):
        return "an array"
    return kind_of(known) if known is not None else "a primitive type"


def read_packages(project: Project) -> dict[str, set[str]]:
    """The names in each package whose whole folder was read, not only its `msg` for instance."""
    found: dict[str, set[str]] = {}
    for file in project.files:
        for statement, read in file.imports:
            if (
                isinstance(statement, ImportRos)
                and Path(statement.path).name not in INTERFACE_KINDS
            ):
                for node in read.model.declarations:
                    found.setdefault(node.name.partition("/")[0], set())
    for _, node in project.declarations():
        package, _, name = node.name.rpartition("/")
        if package in found:
            found[package].add(name)
    return found


def make_context(project: Project, report: Diagnostics, known: Known | None = None) -> Context:
    """Gather the interfaces of all files; `known` is what earlier checks have left."""
    damaged: set[TopLevel] = {node for file in project.files for node in file.parsed.damaged}
    interfaces = Interfaces(
        # Of a damaged enum one still knows that it is one.
        (
            (file, node)
            for file, node in project.declarations()
            if node not in damaged or isinstance(node, EnumType)
        ),
        read_packages(project),
    )
    return Context(report, interfaces, Typing(interfaces, report), damaged, known or Known())
