"""Resolve names across files.

Sets `Ref.target`, `TypeRef.type`, `NameUse.target` and `Activity.owner`. An unresolved name is
reported and stays None; later phases ignore it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from typing import Any

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.constant_cycles import open_cycles
from swarmdsl.analysis.resolve.inheritance import all_items, by_name
from swarmdsl.analysis.resolve.machines import link_expression_of_machine, link_machine
from swarmdsl.analysis.resolve.members import link_member
from swarmdsl.analysis.resolve.properties import link_fitness, link_property
from swarmdsl.analysis.resolve.report_unresolved import (
    report_activity,
    report_missing_inside,
    report_reference,
)
from swarmdsl.analysis.resolve.scopes import FileScope, Scopes, Unresolved
from swarmdsl.analysis.resolve.space import link_environment, link_model, link_sights, link_starts
from swarmdsl.analysis.resolve.swarms import link_optimization, link_swarm
from swarmdsl.analysis.resolve.types import TypeLinker
from swarmdsl.analysis.resolve.values import ValueLinker, Values
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    Activity,
    BehaviorUse,
    Component,
    Container,
    EnumType,
    Environment,
    Event,
    Expression,
    Fitness,
    Function,
    Member,
    Node,
    Operation,
    Optimization,
    Param,
    Part,
    Property,
    Ref,
    State,
    StateMachine,
    Swarm,
    TopLevel,
    TypeRef,
    Variable,
    nodes_of,
    references,
    walk,
)

_TOP_LEVEL: dict[str, type[Any]] = {
    kind.__name__: kind
    for kind in (
        *(StateMachine, Component, Member, Environment, Event, Function, Fitness, Swarm, Property),
    )
}


def link(project: Project, report: Diagnostics) -> None:
    """Resolve all names of a project."""
    linker = Linker(project, Scopes(project))
    owners = [*project.declarations(), *project.optimizations()]
    for file, owner in owners:
        linker.link_outside(file, owner, report)
    linker.gather(owner for _, owner in owners)
    for file, owner in owners:
        linker.link_inside(file, owner, report)
    open_cycles(project, report)


class Linker:
    """Links declarations of a project, in three phases.

    Call `link_outside` for all declarations to link, then `gather` once, then `link_inside`.
    """

    def __init__(self, project: Project, scopes: Scopes) -> None:
        self._scopes = scopes
        self._types = TypeLinker(scopes, project)
        self._enums = {
            node.type: node
            for _, node in project.declarations()
            if isinstance(node, EnumType) and node.type is not None
        }
        self._params: Mapping[StateMachine, dict[str, Param]] = {}
        self._parts: Mapping[StateMachine, dict[str, list[Part]]] = {}

    def link_outside(self, file: File, owner: TopLevel, report: Diagnostics) -> None:
        """Resolve the names of types and of other declarations."""
        for type_ in nodes_of(owner, TypeRef):
            self._types.link(type_, file, report)
        _link_top_level(owner, self._scopes[file], report)

    def gather(self, owners: Iterable[TopLevel]) -> None:
        """Collect the params and parts of members and components for the machines they run."""
        runners = [owner for owner in owners if isinstance(owner, (Member, Component))]
        self._params = _params_of_members(runners)
        self._parts = _parts_of_members(runners)

    def replace(self, machine: StateMachine, other: StateMachine) -> None:
        """Give `other` the params and parts of `machine`."""
        self._params = {**self._params, other: self._params.get(machine, {})}
        self._parts = {**self._parts, other: self._parts.get(machine, {})}

    def link_expression(
        self, expression: Expression, around: Sequence[Container], file: File, report: Diagnostics
    ) -> None:
        """Resolve the names of an expression as if it were in a state of a machine.

        `around` are the containers around it, the machine first; what an inner one declares wins.
        """
        machine, scope = around[0], self._scopes[file]
        assert isinstance(machine, StateMachine)
        for node in walk(expression):
            if isinstance(node, TypeRef):
                self._types.link(node, file, report)
        link_expression_of_machine(expression, around, scope, report)
        values: Values = {**self._params.get(machine, {}), **by_name(machine.items, Param)}
        for each in around:
            values = {**values, **by_name(each.items, Variable)}
        ValueLinker(scope, self._enums, report).link_only([expression], machine, values)

    def link_inside(self, file: File, owner: TopLevel, report: Diagnostics) -> None:
        """Resolve the names of states, values, parts and ports in a declaration."""
        scope = self._scopes[file]
        values: Values = {}
        linked: set[Expression] = set()
        values_of_file = partial(ValueLinker, scope, self._enums, report)
        match owner:
            case StateMachine():
                link_machine(owner, scope, report)
                _link_activities(owner, self._parts.get(owner, {}), scope, report)
                values = {
                    **self._params.get(owner, {}),
                    **by_name(owner.items, Param),
                    **by_name(owner.items, Variable),
                }
            case Member():
                link_member(owner, scope, report)
                values = by_name(all_items(owner, Param), Param)
            case Fitness():
                link_fitness(owner, scope, values_of_file(), report)
                return
            case Optimization():
                link_optimization(owner, scope, report)
            case Swarm():
                link_swarm(owner, scope, report)
                link_starts(owner, scope, report)
            case Environment():
                link_environment(owner, scope, report)
            case Component():
                linked = link_sights(owner, scope, values_of_file(), report)
            case Function():
                linked = link_model(owner, scope, values_of_file())
            case Property():
                link_property(owner, scope, values_of_file(), report)
                return
        others = [each for each in nodes_of(owner, Expression) if each not in linked]
        if others:
            values_of_file().link_only(others, owner, values)


def _link_top_level(owner: TopLevel, scope: FileScope, report: Diagnostics) -> None:
    """Resolve references to other declarations, except those of activities."""
    for node, ref in references(owner):
        kind = _TOP_LEVEL.get(ref.kind)
        if kind is not None and not isinstance(node, Activity):
            bind_reference(node, ref, kind, scope, report)


def bind_reference(
    node: Node, ref: Ref[Any], kind: type[Any], scope: FileScope, report: Diagnostics
) -> None:
    """Resolve a reference from `node` to a declaration of a kind."""
    found = scope.resolve(ref.name, kind)
    if isinstance(found, Unresolved):
        report_reference(found, ref, node, kind, scope, report)
    else:
        ref.target = found


def _params_of_members(
    runners: Iterable[Member | Component],
) -> Mapping[StateMachine, dict[str, Param]]:
    """Return, for each machine, the params that all its members have in common."""
    found: dict[StateMachine, dict[str, Param]] = {}
    for owner in runners:
        params = by_name(all_items(owner, Param), Param)
        for use in all_items(owner, BehaviorUse):
            if use.machine.target is not None:
                common = found.setdefault(use.machine.target, params)
                found[use.machine.target] = {k: v for k, v in common.items() if k in params}
    return found


def _parts_of_members(
    runners: Iterable[Member | Component],
) -> Mapping[StateMachine, dict[str, list[Part]]]:
    """Return, for each machine, the parts by name that all its members have in common."""
    found: dict[StateMachine, dict[str, list[Part]]] = {}
    for owner in runners:
        parts = by_name(all_items(owner, Part), Part)
        for machine in machines_of(owner):
            common = found.setdefault(machine, {name: [] for name in parts})
            found[machine] = {k: [*v, parts[k]] for k, v in common.items() if k in parts}
    return found


def machines_of(runner: Member | Component) -> list[StateMachine]:
    """Return the machines that a member runs: its behaviour and all submachines."""
    work = [use.machine.target for use in all_items(runner, BehaviorUse)]
    seen: dict[StateMachine, None] = {}
    while work:
        machine = work.pop()
        if machine is None or machine in seen:
            continue
        seen[machine] = None
        states = nodes_of(machine, State)
        work += [state.machine.target for state in states if state.machine is not None]
    return list(seen)


def _link_activities(
    machine: StateMachine,
    parts: Mapping[str, list[Part]],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Resolve activities: a function, `part.operation` or `Component.operation`."""
    for node in nodes_of(machine, Activity):
        ref = node.function
        before, _, name = ref.name.rpartition(".")
        places = parts.get(before, [])
        node.owner = places[0] if places else scope.one(before, Component)
        if node.owner is None:
            found = scope.resolve(ref.name, Function)
            if isinstance(found, Unresolved):
                report_activity(found, ref, parts, scope, report)
            else:
                ref.target = found
            continue
        components = [part.component.target for part in places]
        if isinstance(node.owner, Component):
            components = [node.owner]
        known = [component for component in components if component is not None]
        if len(known) < len(components):
            continue  # the component of a part is unknown
        operations = _common_operations(known)
        ref.target = operations.get(name)
        if ref.target is None:
            kind = f"operation of {kind_name(node.owner)} `{before}`"
            report_missing_inside(kind, name, ref.span, operations, scope, report)


def _common_operations(components: list[Component]) -> dict[str, Operation]:
    """Return the operations that all components have, several ones through a common base."""
    first, *others = (by_name(all_items(each, Operation), Operation) for each in components)
    return {k: v for k, v in first.items() if all(other.get(k) is v for other in others)}
