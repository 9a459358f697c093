"""The ROS nodes of a member: one for each machine that it or a part of it runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.base.naming import fresh, snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.shared.constants import Value, constant, params_by_name
from swarmdsl.codegen.shared.wiring import Remaps, member_wiring
from swarmdsl.ir import Component, Expression, Member, Param, Part, StateMachine, System


@dataclass(frozen=True)
class ParamValue:
    """What the model gives a param of a machine; `value` is None where nothing is known yet."""

    param: Param
    expression: Expression | None
    value: Value | None


@dataclass(frozen=True)
class BehaviorNode:
    """A machine that runs, what its node is called, and the values of its params there.

    `part` is the part of the member whose behaviour it is; None for that of the member itself.
    `remaps` are those of the topics that connectors put elsewhere.
    """

    name: str
    machine: StateMachine
    params: tuple[ParamValue, ...]
    part: str | None = None
    remaps: Remaps = ()


def behavior_nodes(member: Member, system: System) -> Iterator[BehaviorNode]:
    """The nodes for the behaviour of a member, and of those of its parts that have one."""
    machines = {machine.name: machine for machine in system.machines}
    components = {component.name: component for component in system.components}
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


def bringup_package(system: System) -> str:
    """The package that target `skeleton` writes to start the nodes of members' components."""
    return f"{snake_case(system.name)}_bringup"


def has_node(component: Component) -> bool:
    """Whether a component needs a node besides that of its behaviour."""
    return bool(component.ports or component.operations)


def behavior_name(part: Part, component: Component, member: Member) -> str:
    """What the node with the behaviour of a part is called.

    It has the part's name, unless that is what the node for its ports and operations is called.
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
    """The params that the machine has, with the values of its owner, else its own.

    `values` are those of a part, in which params of the member, `around`, can be meant.
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
