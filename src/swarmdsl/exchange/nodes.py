"""The ROS nodes of a member: one for each machine that it or a part of it runs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.dataclass import dataclass
from swarmdsl.exchange.constants import Value, constant, params_by_name
from swarmdsl.ir import Expression, Member, Param, StateMachine, System
from swarmdsl.naming import snake_case


@dataclass(frozen=True)
class Given:
    """What the model gives a param of a machine; `value` is None where nothing is known yet."""

    param: Param
    expression: Expression | None
    value: Value | None


@dataclass(frozen=True)
class BehaviorNode:
    """A machine that runs, what its node is called, and the values of its params there."""

    name: str
    machine: StateMachine
    params: tuple[Given, ...]


def behavior_nodes(member: Member, system: System) -> Iterator[BehaviorNode]:
    """The nodes for the behaviour of a member, and of those of its parts that have one."""
    machines = {machine.name: machine for machine in system.machines}
    components = {component.name: component for component in system.components}
    if member.behavior is not None:
        machine = machines[member.behavior]
        params = _given(machine, member.params, {})
        yield BehaviorNode(snake_case(machine.name), machine, params)
    for part in member.parts:
        component = components[part.component]
        if component.behavior is not None:
            machine = machines[component.behavior]
            params = _given(machine, component.params, dict(part.values))
            yield BehaviorNode(part.name, machine, params)


def _given(
    machine: StateMachine, params: tuple[Param, ...], values: Mapping[str, Expression]
) -> tuple[Given, ...]:
    """The params that the machine has, with the values of its owner, else its own."""
    known = {**params_by_name(machine.params), **params_by_name(params)}
    given = {**{param.name: param.default for param in params}, **values}
    found = []
    for param in machine.params:
        expression = given.get(param.name) or param.declared
        value = constant(expression, known) if expression is not None else None
        found.append(Given(param, expression, value))
    return tuple(found)
