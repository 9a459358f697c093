"""Find the references to declarations."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.node_kinds import KINDS
from swarmdsl.analysis.resolve.identities import role_uses
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.resolve.scopes import FileScope, Scopes
from swarmdsl.analysis.resolve.set_params import set_params
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.field_references import FIELDS, field_references
from swarmdsl.project.libraries import imported_name, place_of
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Choice,
    EnumType,
    FieldUse,
    FinalState,
    Fitness,
    History,
    NameUse,
    Node,
    Parallel,
    Param,
    Property,
    Region,
    State,
    StateMachine,
    TopLevel,
    TypeRef,
    by_class,
    children,
    nodes_of,
    references,
    walk,
)

_VERTICES = (State, Parallel, Choice, History, FinalState)


@dataclass(frozen=True)
class Occurrence:
    """A name in a file and its declaration; `declares` at the declaration itself."""

    span: Span
    node: Node
    declares: bool = False


def owners(file: File) -> Iterator[TopLevel]:
    """Yield the top-level elements of a file."""
    yield from file.model.declarations
    yield from file.model.optimizations


def owner_at(file: File, offset: int) -> TopLevel | None:
    """Return the top-level element at an offset."""
    for owner in owners(file):
        span = owner.span.absolute
        if span.start <= offset <= span.end:
            return owner
    return None


def occurrence_at(workspace: Workspace, file: File, offset: int) -> Occurrence | None:
    """Return the name at an offset or ending there."""
    owner = owner_at(file, offset)
    found = _imported(file)
    if owner is not None:
        found = occurrences(owner, Scopes(workspace.project)[file])
    inside = [each for each in found if each.span.start <= offset <= each.span.end]
    if not inside and owner is not None:
        fields = _fields(owner, Interfaces(workspace.project.declarations()))
        inside = [each for each in fields if each.span.start <= offset <= each.span.end]
    return min(inside, key=lambda each: each.span.end - each.span.start, default=None)


def occurrences_of(node: Node, workspace: Workspace) -> Iterator[Occurrence]:
    """Yield all references to a declaration, in the order of the files."""
    scopes = Scopes(workspace.project)
    name = getattr(node, "name", "")
    is_field = isinstance(node, FIELDS)
    interfaces = Interfaces(workspace.project.declarations()) if is_field else None
    for file in workspace.project.files:
        if name not in file.source.text:
            continue
        yield from (each for each in _imported(file) if each.node is node)
        for owner in owners(file):
            if name in owner.span.text:
                yield from (each for each in occurrences(owner, scopes[file]) if each.node is node)
                if interfaces is not None:
                    yield from (each for each in _fields(owner, interfaces) if each.node is node)


def occurrences(owner: TopLevel, scope: FileScope) -> Iterator[Occurrence]:
    """Yield the resolved names in a declaration, except for fields."""
    for kind, found in by_class(owner).items():
        if kind in KINDS:
            for node in found:
                yield Occurrence(node.name.span.absolute, node, declares=True)
    around: dict[StateMachine, dict[Node, Node]] = {}
    for _, ref in references(owner):
        if ref.target is not None:
            yield _last_segment(ref.span, ref.name, ref.target)
            if "." in ref.name and isinstance(ref.target, _VERTICES):
                machine = _machine_of(ref.target, owner, scope)
                if machine not in around:
                    around[machine] = _parent_states(machine)
                yield from _parent_segments(ref.span, ref.name, ref.target, around[machine])
    for use in nodes_of(owner, NameUse):
        if use.target is not None:
            yield _last_segment(use.span, use.name, use.target)
    if isinstance(owner, (StateMachine, Property, Fitness)):
        for span, role in role_uses(owner, scope.project):
            yield Occurrence(span.absolute, role)
    for type_ in nodes_of(owner, TypeRef):
        found = scope.find(type_.name)
        if len(found) == 1:
            source, start, _ = type_.span
            yield _last_segment(
                Span(source, start, start + len(type_.name)), type_.name, found[0][1]
            )
    yield from _values(owner)


def _fields(owner: TopLevel, interfaces: Interfaces) -> Iterator[Occurrence]:
    """Yield the names of fields where they are used."""
    for span, field in field_references(owner, interfaces):
        yield Occurrence(span, field)


def _imported(file: File) -> Iterator[Occurrence]:
    """Yield the declarations that a file imports by name."""
    for statement, other in file.imports:
        name = imported_name(statement)
        for node in other.model.declarations if name is not None else ():
            if name is not None and node.name == name:
                yield _last_segment(place_of(statement), name, node)


def _values(owner: TopLevel) -> Iterator[Occurrence]:
    """Yield names of enum values, and of params that parts, roles and states set."""
    for use in nodes_of(owner, FieldUse):
        enum = use.base.target if isinstance(use.base, NameUse) else None
        if isinstance(enum, EnumType):
            value = next((each for each in enum.values if each.name == use.name), None)
            if value is not None:
                yield Occurrence(use.name.span.absolute, value)
    for state in nodes_of(owner, State):
        machine = state.machine.target if state.machine is not None else None
        for binding in state.bindings if machine is not None else ():
            for item in machine.items if machine is not None else ():
                if isinstance(item, Param) and item.name == binding.name:
                    yield Occurrence(binding.name.span.absolute, item)
    for of, values in set_params(owner):
        params = {str(each.name): each for each in all_items(of, Param)} if values else {}
        for each in values:
            if each.name in params:
                yield Occurrence(each.name.span.absolute, params[each.name])


def _last_segment(span: Span, name: str, node: Node) -> Occurrence:
    """Return the last segment of a name, which may be qualified."""
    source, _, end = span.absolute
    return Occurrence(Span(source, end - len(name.rpartition(".")[2]), end), node)


def _parent_segments(
    span: Span, name: str, node: Node, around: dict[Node, Node]
) -> Iterator[Occurrence]:
    """Yield the segments of a state path (`Search.Sweep`) except for the last."""
    source, _, end = span.absolute
    names = name.split(".")
    end -= len(names.pop())
    while names and node in around:
        node = around[node]
        end -= 1
        word = names.pop()
        yield Occurrence(Span(source, end - len(word), end), node)
        end -= len(word)


def _machine_of(state: Node, owner: TopLevel, scope: FileScope) -> StateMachine:
    """Return the machine of a state that is named in a declaration, mostly this machine."""
    if isinstance(owner, StateMachine):
        return owner
    source, at, _ = state.span
    for _, each in scope.project.declarations():
        span = each.span
        inside = span.source is source and span.start <= at < span.end
        if inside and isinstance(each, StateMachine):
            return each
    raise AssertionError("a state is in a machine")


def _parent_states(machine: StateMachine) -> dict[Node, Node]:
    """Map each state to its parent state; regions are no part of a path."""
    found: dict[Node, Node] = {}
    for outer in walk(machine):
        for inner in children(outer):
            found[inner] = found.get(outer, outer) if isinstance(outer, Region) else outer
    return found
