"""Data and predicates that several checks share."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any, TypeVar

from swarmdsl.analysis.checks.facts import Condition, FactCache
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.analysis.event_typing import on_events
from swarmdsl.analysis.node_kinds import kind_of
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types import Typing, check_types, constant, fits, is_number
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import dataclass, field, replace
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.project.loader import File, Project
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
    Node,
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

A = TypeVar("A")
N = TypeVar("N", bound=Node)


@dataclass(frozen=True)
class Context:
    """Input and shared results of all checks.

    `incomplete` are the declarations with a part that could not be parsed: a check for missing
    items would mislead there. `used` are the declarations of the system with their files, set
    by a pass over the project. `errors_only` is set for a library, whose warnings are dropped.
    `models` are the function models of the project itself.
    """

    report: Diagnostics
    interfaces: Interfaces
    typing: Typing
    incomplete: set[TopLevel]
    facts: FactCache
    errors_only: bool = False
    models: frozenset[str] = frozenset()
    used: list[tuple[File, Declaration]] = field(default_factory=list)
    conditions: dict[Transition | Branch, Condition] = field(default_factory=dict)
    guard_values: dict[Transition | Branch, bool | None] = field(default_factory=dict)
    hierarchies: dict[StateMachine, StateHierarchy] = field(default_factory=dict)
    analyses: dict[object, Any] = field(default_factory=dict)

    def reporting_to(self, report: Diagnostics) -> Context:
        """Return the context with another collector."""
        return replace(self, report=report, typing=replace(self.typing, report=report))

    def hierarchy(self, machine: StateMachine) -> StateHierarchy:
        """Return the hierarchy of the states of a machine."""
        if machine not in self.hierarchies:
            self.hierarchies[machine] = StateHierarchy(machine)
        return self.hierarchies[machine]

    def analysis(self, kind: Callable[[N, Context], A], node: N) -> A:
        """Return the result of an analysis of a machine or a state, computed on first use."""
        key = (kind, node)
        if key not in self.analyses:
            self.analyses[key] = kind(node, self)
        result: A = self.analyses[key]
        return result

    def forget(self, declaration: Declaration) -> None:
        """Drop what is kept for a declaration whose checks are done."""
        if isinstance(declaration, StateMachine):
            self.hierarchies.pop(declaration, None)
            self.analyses.clear()
            self.conditions.clear()
            self.guard_values.clear()

    def expect(self, expression: Expression | None, expected: Type | None, typing: Typing) -> None:
        """Check the type of an expression."""
        if expression is not None:
            typing.expect(expression.tree, expected)

    def check_fits(self, found: Type | None, expected: Type | None, at: Span) -> None:
        """Check that a value of type `found` can be stored as `expected`."""
        if not fits(found, expected):
            self.report.report("type-mismatch", at, expected=f"`{expected}`", found=f"`{found}`")
        else:
            check_types(found, expected, at, self.report)

    def check_default(self, owner: Param | Variable, value: Expression | None) -> None:
        """Check an initial or default value: a constant of the type of its owner."""
        if value is not None:
            help_ = None
            if isinstance(owner, Variable):
                set_ = f"`entry / {owner.name} = {value.span.text}`"
                help_ = f"set it when the initial state is entered: {set_}"
            self.check_constant(value, owner.type.type, help_)

    def check_constant(
        self, value: Expression, expected: Type | None, help_: str | None = None
    ) -> None:
        """Check a constant of a type; `help_` is for a value that is none."""
        if value.tree is None:
            return
        if not constant(value.tree):
            self.report.report("not-constant", value.span, help=help_)
        self.typing.expect(value.tree, expected)

    def check_number(self, value: Expression) -> None:
        """Check that a value is a number."""
        if value.tree is None:
            return
        found = self.typing.infer(value.tree)
        if found is not None and not is_number(found):
            self.report.report("type-mismatch", value.span, expected="a number", found=f"`{found}`")

    def check_kind(self, ref: TypeRef, kind: type[Interface]) -> None:
        """Check that a type is a message, an action or a service, if its interface is known."""
        element = ref.type.element if isinstance(ref.type, Array) else ref.type
        known = self.interfaces.get(element, kind) if isinstance(element, Named) else None
        unknown = isinstance(element, Named) and known is None
        # A struct is a message that a model defines.
        kinds = (MessageType, StructType) if kind is MessageType else kind
        fine = element is ref.type and (unknown or isinstance(known, kinds))
        if ref.type is not None and not fine:
            self.report.report(
                "interface-kind",
                ref.span,
                name=ref.span.text,
                actual=_kind_of_type(ref, known),
                expected=kind_of(kind),
                related=(Label(known.name.span, "declared here"),) if known else (),
            )

    def check_repeated(self, names: Iterable[Word], what: str) -> None:
        """Report the second of two items with the same name."""
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
        """Report a value for a param that is missing in its owner."""
        hints = self.report.wants_hint("unknown-param")
        help_ = suggest(name, params, "params") if hints else None
        self.report.report("unknown-param", name.span, owner=owner, name=name, help=help_)

    def check_single(self, places: list[Span], what: str) -> None:
        """Report all but the first place of an item that may be given once."""
        for place in places[1:]:
            self.report.report(
                "repeated-item", place, item=what, related=(Label(places[0], "first given here"),)
            )

    def with_event(self, triggers: list[EventTrigger | MonitorTrigger]) -> Typing:
        """Return a typing in which `event` is the message of any of these triggers."""
        return on_events(triggers, self.typing)


def _kind_of_type(ref: TypeRef, known: Interface | None) -> str:
    if isinstance(ref.type, Array):
        return "an array"
    return kind_of(known) if known is not None else "a primitive type"


def read_packages(project: Project) -> dict[str, set[str]]:
    """Return the names in each package whose whole folder was imported.

    An import of a subfolder like `msg` does not count.
    """
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


def make_context(project: Project, report: Diagnostics, facts: FactCache | None = None) -> Context:
    """Create the context of a project; `facts` are those of an earlier check."""
    incomplete: set[TopLevel] = {node for file in project.files for node in file.parsed.incomplete}
    interfaces = Interfaces(
        # An incomplete enum is still known to be an enum.
        (
            (file, node)
            for file, node in project.declarations()
            if node not in incomplete or isinstance(node, EnumType)
        ),
        read_packages(project),
    )
    typing = Typing(interfaces, report)
    found = facts or FactCache()
    return Context(report, interfaces, typing, incomplete, found, models=project.models)
