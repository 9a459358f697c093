"""The names in a model, each with the declaration that it means."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.node_kinds import KINDS
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.scopes import FileScope, Scopes
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.project.libraries import imported_name, place_of
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    EnumType,
    FieldUse,
    NameUse,
    Node,
    Param,
    Part,
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


@dataclass(frozen=True)
class Occurrence:
    """A name at a place in a file, and what it means; `declares` where that is declared."""

    span: Span
    node: Node
    declares: bool = False


def owners(file: File) -> Iterator[TopLevel]:
    """All that is declared in a file."""
    yield from file.model.declarations
    yield from file.model.optimizations


def owner_at(file: File, offset: int) -> TopLevel | None:
    """What is declared at an offset of a file."""
    for owner in owners(file):
        span = owner.span.absolute
        if span.start <= offset <= span.end:
            return owner
    return None


def occurrence_at(workspace: Workspace, file: File, offset: int) -> Occurrence | None:
    """The name that an offset is in, or directly behind."""
    owner = owner_at(file, offset)
    found = _imported(file)
    if owner is not None:
        found = occurrences(owner, Scopes(workspace.project)[file])
    inside = (each for each in found if each.span.start <= offset <= each.span.end)
    return min(inside, key=lambda each: each.span.end - each.span.start, default=None)


def occurrences_of(node: Node, workspace: Workspace) -> Iterator[Occurrence]:
    """All names in a model that mean the same, in the order of its files."""
    scopes = Scopes(workspace.project)
    name = getattr(node, "name", "")
    for file in workspace.project.files:
        if name not in file.source.text:
            continue
        yield from (each for each in _imported(file) if each.node is node)
        for owner in owners(file):
            if name in owner.span.text:
                yield from (each for each in occurrences(owner, scopes[file]) if each.node is node)


def occurrences(owner: TopLevel, scope: FileScope) -> Iterator[Occurrence]:
    """The names in a declaration that mean something; those of fields are left out."""
    for kind, found in by_class(owner).items():
        if kind in KINDS:
            for node in found:
                yield Occurrence(node.name.span.absolute, node, declares=True)
    around: dict[Node, Node] = {}
    for _, ref in references(owner):
        if ref.target is not None:
            yield _last(ref.span, ref.name, ref.target)
            if "." in ref.name and isinstance(owner, StateMachine):
                around = around or _around(owner)
                yield from _path(ref.span, ref.name, ref.target, around)
    for use in nodes_of(owner, NameUse):
        if use.target is not None:
            yield _last(use.span, use.name, use.target)
    for type_ in nodes_of(owner, TypeRef):
        found = scope.find(type_.name)
        if len(found) == 1:
            source, start, _ = type_.span
            yield _last(Span(source, start, start + len(type_.name)), type_.name, found[0][1])
    yield from _values(owner)


def _imported(file: File) -> Iterator[Occurrence]:
    """What a file imports by its name."""
    for statement, other in file.imports:
        name = imported_name(statement)
        for node in other.model.declarations if name is not None else ():
            if name is not None and node.name == name:
                yield _last(place_of(statement), name, node)


def _values(owner: TopLevel) -> Iterator[Occurrence]:
    """Names beside values: of an enum, of the params of parts and of reused machines."""
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
    for part in nodes_of(owner, Part):
        if part.component.target is not None:
            params = {str(each.name): each for each in all_items(part.component.target, Param)}
            for value_ in part.values:
                if value_.name in params:
                    yield Occurrence(value_.name.span.absolute, params[value_.name])


def _last(span: Span, name: str, node: Node) -> Occurrence:
    """The last word of a name, which may begin with a package."""
    source, _, end = span.absolute
    return Occurrence(Span(source, end - len(name.rpartition(".")[2]), end), node)


def _path(span: Span, name: str, node: Node, around: dict[Node, Node]) -> Iterator[Occurrence]:
    """The words before the last one of a path to a state (`Search.Sweep`): each means one."""
    source, _, end = span.absolute
    words = name.split(".")
    end -= len(words.pop())
    while words and node in around:
        node = around[node]
        end -= 1
        word = words.pop()
        yield Occurrence(Span(source, end - len(word), end), node)
        end -= len(word)


def _around(machine: StateMachine) -> dict[Node, Node]:
    """The state around each state; regions are no part of a path."""
    found: dict[Node, Node] = {}
    for outer in walk(machine):
        for inner in children(outer):
            found[inner] = found.get(outer, outer) if isinstance(outer, Region) else outer
    return found
