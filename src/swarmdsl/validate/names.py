"""No name is declared twice where one of the two would be hidden."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Iterable
from typing import TypeVar

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.draft import stands_for_nothing
from swarmdsl.inheritance import all_items, lineage
from swarmdsl.ir.types import PRIMITIVES
from swarmdsl.link_machines import regions, vertices
from swarmdsl.link_types import interface_name
from swarmdsl.load import Project
from swarmdsl.scopes import bare, kind_of
from swarmdsl.syntax import (
    ActionType,
    Component,
    Declaration,
    EnumType,
    EnumValue,
    Event,
    Field,
    Fitness,
    FitnessInput,
    Function,
    Interface,
    Member,
    MessageType,
    Node,
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
    walk,
)

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
)

N = TypeVar("N", bound=Named)

# SCXML's own events start like this (SCXML 1.0, 5.10.1); `done` is a keyword anyway.
RESERVED_EVENTS = ("error",)


def check_names(project: Project, report: Diagnostics) -> None:
    """Check top-level names across files."""
    top_level: dict[Hashable, Declaration] = {}
    for file, declaration in project.declarations():
        name = str(declaration.name)
        _check_first((file.package, name), declaration, top_level, report)
        if isinstance(declaration, Interface):
            # `Pose` of package `geo` and `geo/Pose` are one interface.
            _check_first(interface_name(file, name), declaration, top_level, report)


def check_names_inside(
    declaration: Declaration, report: Diagnostics, lost: Collection[str] = ()
) -> None:
    """Check all names inside a declaration, and that its own may be used.

    Of the `lost` words, which stand where the text is wrong, those of types are no names.
    """
    no_names = set(PRIMITIVES).intersection(lost)
    if isinstance(declaration, Event) and declaration.name in RESERVED_EVENTS:
        report.report(
            "reserved-event-name",
            declaration.name.span,
            name=declaration.name,
            help="SCXML keeps it for errors of its own",
        )
    for node in walk(declaration):
        for names in _namespaces(node) if type(node) in _WITH_NAMES else ():
            among = [named for named in names if named.name not in no_names]
            if len({named.name for named in among}) == len(among):
                continue
            seen: dict[Hashable, Named] = {}
            for named in among:
                _check_first(str(named.name), named, seen, report)


_WITH_NAMES = frozenset(
    (
        *(StructType, MessageType, ServiceType, ActionType, Function, Component, Member),
        *(EnumType, Operation, Fitness, Swarm, StateMachine, Parallel, State, Region),
    )
)


def _namespaces(node: Node) -> Iterable[Iterable[Named]]:
    """The groups of named things in a node whose names must differ."""
    match node:
        case StructType(fields=fields):
            return (fields,)
        case MessageType(fields=fields, constants=constants):
            return ([*constants, *fields],)
        case ServiceType(request=request, response=response):
            return (request, response)
        case ActionType(goal=goal, result=result, feedback=feedback):
            return (goal, result, feedback)
        case Function(items=items):
            return ([item for item in items if isinstance(item, Param)],)
        case Component() | Member():
            return (_items(node),)
        case EnumType(values=values):
            return (values,)
        case Operation(parameters=parameters):
            return (parameters,)
        case Fitness(items=items):
            return ([item for item in items if isinstance(item, (FitnessInput, Param))],)
        case Swarm(items=items):
            return ([item for item in items if isinstance(item, Role)],)
        case StateMachine(items=items):
            return (
                [item for item in items if isinstance(item, (Param, Variable))],
                vertices(node),
            )
        case Parallel():
            return (regions(node),)
        case State() | Region():
            return (vertices(node),)
    return ()


def _items(owner: Component | Member) -> list[Port | Param | Operation | Part]:
    """The named items, inherited ones first, without params that others take the place of."""
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


def _check_first(key: Hashable, named: N, seen: dict[Hashable, N], report: Diagnostics) -> None:
    name: Word = named.name
    if stands_for_nothing(name):
        return
    first = seen.setdefault(key, named)
    if first is not named:
        kind, earlier = kind_of(named), kind_of(first)
        also = "" if kind == earlier else f", as {earlier}"
        report.report(
            "duplicate-name",
            name.span,
            kind=bare(kind),
            name=name,
            related=(Label(first.name.span, f"first declared here{also}"),),
        )
