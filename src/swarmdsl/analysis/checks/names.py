"""Checks of repeated and reserved names."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.node_kinds import kind_name, kind_of
from swarmdsl.analysis.resolve.inheritance import all_items, lineage
from swarmdsl.analysis.resolve.interfaces import is_secondary_description, own_interfaces
from swarmdsl.analysis.resolve.states import regions, vertices
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    ActionType,
    Area,
    Component,
    Container,
    Declaration,
    EnumType,
    EnumValue,
    Environment,
    Event,
    Field,
    Fitness,
    FitnessInput,
    Function,
    Interface,
    Member,
    MessageType,
    Node,
    Obstacle,
    Operation,
    Parallel,
    Param,
    Parameter,
    Part,
    Port,
    Region,
    Role,
    ServiceType,
    State,
    StateMachine,
    StructType,
    Swarm,
    Variable,
    Vertex,
    Word,
    Zone,
    by_class,
)
from swarmdsl.syntax.parser.patched_text import is_placeholder
from swarmdsl.syntax.types import PRIMITIVES

Named = (
    Declaration
    | Field
    | EnumValue
    | Operation
    | Parameter
    | FitnessInput
    | Param
    | Port
    | Part
    | Variable
    | Vertex
    | Region
    | Role
    | Area
    | Zone
    | Obstacle
)

N = TypeVar("N", bound=Named)

# Prefix of the events of SCXML itself (SCXML 1.0, 5.10.1); `done` is a keyword anyway.
RESERVED_EVENTS = ("error",)


def check_names(project: Project, context: Context) -> None:
    """Check top-level names across files.

    A project may declare an interface of ROS that a library describes too.
    """
    top_level: dict[Hashable, Declaration] = {}
    own = own_interfaces(project)
    for file in project.files:
        package = file.package
        for declaration in file.model.declarations:
            name = str(declaration.name)
            _check_first((package, name), declaration, top_level, context.report)
            if isinstance(declaration, Interface):
                # `Pose` of package `geo` and `geo/Pose` are one interface.
                described = interface_name(file, name)
                if not (is_secondary_description(file) and described in own):
                    _check_first(described, declaration, top_level, context.report)


def check_names_inside(
    declaration: Declaration, report: Diagnostics, skipped: Collection[str] = ()
) -> None:
    """Check all names inside a declaration, and that its own name is not reserved.

    Primitive types among the `skipped` words of invalid text are no names.
    """
    no_names = set(PRIMITIVES).intersection(skipped)
    if isinstance(declaration, Event) and declaration.name in RESERVED_EVENTS:
        report.report(
            "reserved-event-name",
            declaration.name.span,
            name=declaration.name,
            help="SCXML reserves it for its own errors",
        )
    for kind, nodes in by_class(declaration).items():
        if kind not in _NAMESPACES:
            continue
        for among in (names for node in nodes for names in _NAMESPACES[kind](node)):
            if len(among) < 2 or len({named.name for named in among}) == len(among):
                continue
            seen: dict[Hashable, Named] = {}
            for named in among:
                if named.name not in no_names:
                    _check_first(str(named.name), named, seen, report)


def _items(owner: Component | Member) -> list[Port | Param | Operation | Part]:
    """Named items, the inherited ones first, without replaced params."""
    kinds = (Port, Param, Operation, Part)
    own = [item for item in owner.items if isinstance(item, kinds)]
    params = set(all_items(owner, Param))
    inherited = [
        item
        for base in reversed(lineage(owner)[1:])
        for item in base.items
        if isinstance(item, kinds) and (item in params or not isinstance(item, Param))
    ]
    return [*inherited, *own]


def _values(
    container: Container, around: Mapping[str, Param | Variable] | None = None
) -> Iterator[Sequence[Param | Variable]]:
    """Yield the values that each state with variables sees, the outer ones first."""
    own = [item for item in container.items if isinstance(item, (Param, Variable))]
    first = dict(around or {})
    if own:
        yield [*first.values(), *own]
    for each in own:
        first.setdefault(str(each.name), each)
    for inside in (*vertices(container), *regions(container)):
        if isinstance(inside, (State, Parallel, Region)):
            yield from _values(inside, first)


def _of(*kinds: type[Named]) -> Callable[[Any], Iterable[Sequence[Named]]]:
    """Return a function for the items of these kinds in a node."""
    return lambda node: ([item for item in node.items if isinstance(item, kinds)],)


# Groups of items in a node whose names must differ.
_NAMESPACES: Mapping[type[Node], Callable[[Any], Iterable[Sequence[Named]]]] = {
    StructType: lambda node: (node.fields,),
    MessageType: lambda node: ([*node.constants, *node.fields],),
    ServiceType: lambda node: (node.request, node.response),
    ActionType: lambda node: (node.goal, node.result, node.feedback),
    Function: _of(Param),
    Component: lambda node: (_items(node),),
    Member: lambda node: (_items(node),),
    EnumType: lambda node: (node.values,),
    Operation: lambda node: (node.parameters,),
    Fitness: _of(FitnessInput, Param),
    Swarm: _of(Role),
    Environment: _of(Area, Zone, Obstacle),
    StateMachine: lambda node: (
        *_values(node),
        vertices(node),
    ),
    Parallel: lambda node: (regions(node),),
    State: lambda node: (vertices(node),),
    Region: lambda node: (vertices(node),),
}


def _check_first(key: Hashable, named: N, seen: dict[Hashable, N], report: Diagnostics) -> None:
    name: Word = named.name
    if is_placeholder(name):
        return
    first = seen.setdefault(key, named)
    if first is not named:
        kind, earlier = kind_of(named), kind_of(first)
        also = "" if kind == earlier else f", as {earlier}"
        report.report(
            "duplicate-name",
            name.span,
            kind=kind_name(named),
            name=name,
            related=(Label(first.name.span, f"first declared here{also}"),),
        )
