"""Names to what they mean, across files.

Sets `Ref.target`, `TypeRef.type` and `NameUse.target`. What a name does not mean is
reported and stays None; later phases pass over it without a word.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.link_machines import link_machine
from swarmdsl.link_types import TypeLinker
from swarmdsl.load import Project
from swarmdsl.scopes import FileScope, bare, kind_of, report_unresolved
from swarmdsl.syntax import (
    BehaviorUse,
    Component,
    Connector,
    Environment,
    Event,
    Function,
    Member,
    NameUse,
    Node,
    Param,
    Part,
    Port,
    PortRef,
    Ref,
    StateMachine,
    TypeRef,
    Variable,
    walk,
)

_TOP_LEVEL: dict[str, type[Any]] = {
    kind.__name__: kind for kind in (StateMachine, Component, Member, Environment, Event, Function)
}

Values = Mapping[str, Variable | Param]


def link(project: Project, report: Diagnostics) -> None:
    """Resolve every name of every file."""
    scopes = {file: FileScope(file, project) for file in project.files}
    types = TypeLinker(scopes, report)
    for file, declaration in project.declarations():
        for node in walk(declaration):
            if isinstance(node, TypeRef):
                types.link(node, file)
            _link_top_level(node, scopes[file], report)
    params = _params_of_members(project)
    for file, declaration in project.declarations():
        scope = scopes[file]
        match declaration:
            case StateMachine():
                link_machine(declaration, scope, report)
                link_values(declaration, params[declaration] | _values(declaration), scope, report)
            case Member():
                _link_member(declaration, scope, report)
                link_values(declaration, _values(declaration), scope, report)
            case Function() | Component():
                link_values(declaration, {}, scope, report)


def link_values(owner: Node, values: Values, scope: FileScope, report: Diagnostics) -> None:
    """Bind the names in the expressions of a declaration to its variables and params."""
    for node in walk(owner):
        if not isinstance(node, NameUse) or node.name == "event":
            continue
        node.target = values.get(node.name)
        if node.target is None and node.name not in scope.lost:
            report_unresolved("variable or param", node.name, node.span, values, None, report)


def _link_top_level(node: Node, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the references of a node to top-level declarations."""
    for ref in _refs(node):
        kind = _TOP_LEVEL.get(ref.kind)
        if kind is not None:
            ref.target = scope.resolve(ref.name, ref.span, kind, report)


def _refs(node: Node) -> Iterable[Ref[Any]]:
    for attribute in node.__dataclass_fields__:
        value = getattr(node, attribute)
        if isinstance(value, Ref):
            yield value


def _params_of_members(project: Project) -> Mapping[StateMachine, dict[str, Param | Variable]]:
    """For each machine the params that all members which behave so have in common."""
    found: dict[StateMachine, dict[str, Param | Variable]] = {}
    for _, member in project.declarations():
        if not isinstance(member, Member):
            continue
        params: dict[str, Param | Variable] = {
            str(item.name): item for item in member.items if isinstance(item, Param)
        }
        for item in member.items:
            if isinstance(item, BehaviorUse) and item.machine.target is not None:
                common = found.setdefault(item.machine.target, params)
                found[item.machine.target] = {k: v for k, v in common.items() if k in params}
    return defaultdict(dict, found)


def _values(owner: StateMachine | Member) -> dict[str, Variable | Param]:
    return {str(item.name): item for item in owner.items if isinstance(item, (Variable, Param))}


# ---- members


def _link_member(member: Member, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the two ends of each connector."""
    parts = {str(item.name): item for item in member.items if isinstance(item, Part)}
    own = {str(item.name): item for item in member.items if isinstance(item, Port)}
    for item in member.items:
        if isinstance(item, Connector):
            for end in (item.source, item.target):
                _link_port(end, member, parts, own, scope, report)


def _link_port(
    end: PortRef,
    member: Member,
    parts: Mapping[str, Part],
    own: Mapping[str, Port],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    if end.part is None:
        end.port.target = own.get(end.port.name)
        if end.port.target is None and end.port.name not in scope.lost:
            _report_missing_port(end.port, f"member `{member.name}`", own, report)
        return
    end.part.target = parts.get(end.part.name)
    if end.part.target is None:
        if end.part.name not in scope.lost:
            report_unresolved("part", end.part.name, end.part.span, parts, None, report)
        return
    component = end.part.target.component.target
    if component is None:
        return
    ports = {str(item.name): item for item in component.items if isinstance(item, Port)}
    end.port.target = ports.get(end.port.name)
    if end.port.target is None and end.port.name not in scope.lost:
        owner = f"{bare(kind_of(component))} `{component.name}`"
        _report_missing_port(end.port, owner, ports, report)


def _report_missing_port(
    port: Ref[Port], owner: str, ports: Mapping[str, Port], report: Diagnostics
) -> None:
    report_unresolved(f"port of {owner}", port.name, port.span, ports, None, report)
