"""ROS nodes of a member: one for each machine that it or a part of it runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.base.naming import fresh, snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.shared.constants import Value, constant, params_by_name
from swarmdsl.codegen.shared.wiring import Remaps, member_wiring
from swarmdsl.ir import Component, Expression, Member, Param, Part, StateMachine, System


@dataclass(frozen=True)
class ParamValue:
    """Value of a machine's param in the model; `value` is None if not known yet."""

    param: Param
    expression: Expression | None
    value: Value | None


@dataclass(frozen=True)
class BehaviorNode:
    """Node that runs a machine, with the values of its params.

    `part` is the part of the member whose behaviour it is; None for that of the member itself.
    `remaps` are the topics that connectors replace.
    """

    name: str
    machine: StateMachine
    params: tuple[ParamValue, ...]
    part: str | None = None
    remaps: Remaps = ()


def behavior_nodes(member: Member, system: System) -> Iterator[BehaviorNode]:
    """Yield the nodes for the behaviours of a member and of its parts."""
    machines = system.machines_by_name
    components = system.components_by_name
    if member.behavior is not None:
        machine = machines[member.behavior]
        params = _given(machine, member.params, {}, {})
        yield BehaviorNode(snake_case(machine.name), machine, params)
    wired = member_wiring(member, system)
    for part in member.parts:
        component = components[part.component]
        if component.behavior is not None:
            machine = machines[component.behavior]
            values, around = dict(part.values), params_by_name(member.params)
            params = _given(machine, component.params, values, around)
            name = behavior_name(part, component, member)
            yield BehaviorNode(name, machine, params, part.name, wired.remaps(part.name))


def member_functions(member: Member, system: System) -> list[str]:
    """Return the functions of the model, outside libraries, that a member's behaviours call.

    Those of its components are not among them: the nodes of the components have them.
    """
    operations = {name for each in system.components for name in each.operations}
    operations |= {
        name for each in system.members for part in each.parts for name in part.operations
    }
    found: dict[str, None] = {}
    for node in behavior_nodes(member, system):
        for state in node.machine.walk():
            if state.activity is not None:
                name = state.activity.function
                if not system.function(name).in_library and name not in operations:
                    found.setdefault(name)
    return list(found)


def bringup_package(system: System) -> str:
    """Return the package of target `skeleton` that starts members' functions and components."""
    return f"{snake_case(system.name)}_bringup"


def has_node(component: Component) -> bool:
    """Return True if a component needs a node besides that of its behaviour."""
    return bool(component.ports or component.operations)


def behavior_name(part: Part, component: Component, member: Member) -> str:
    """Return the name of the node with the behaviour of a part.

    It is the part's name, unless the node for its ports and operations has that name.
    """
    if not has_node(component):
        return part.name
    return fresh(f"{part.name}_behavior", (each.name for each in member.parts))


def _given(
    machine: StateMachine,
    params: tuple[Param, ...],
    values: Mapping[str, Expression],
    around: Mapping[str, Param],
) -> tuple[ParamValue, ...]:
    """Return the params of the machine, with the values of its owner, else its own.

    `values` are those of a part, which may refer to params of the member, `around`.
    """
    known = {**params_by_name(machine.params), **params_by_name(params)}
    given = {**{param.name: param.default for param in params}, **values}
    found = []
    for param in machine.params:
        expression = given.get(param.name) or param.declared
        meant = around if param.name in values else known
        value = constant(expression, meant) if expression is not None else None
        found.append(ParamValue(param, expression, value))
    return tuple(found)
