"""Normal form of a system that one file can express.

Lowering one file yields this form already, except for the last two points, which are rare:

- The interfaces of the model belong to the package of the system. If another package
  declares the same name, the package becomes a prefix, as in names of other declarations.
- A member or component has each param that its behaviour needs a value for. Lowering drops
  the default of a machine if its members do not agree on one.
- If the states of a reused machine differ from those that lowering expands, the origin of
  the states is dropped (`State.submachine`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

from swarmdsl.base.naming import camel_case
from swarmdsl.codegen.swarm_printer.names import all_parts, operation_name, own_operations
from swarmdsl.codegen.swarm_printer.reuse import find_reuse
from swarmdsl.ir import Component, Member, Named, Param, StateMachine, System

Owner = TypeVar("Owner", Component, Member)


def normalized(system: System) -> System:
    """Return the system as its text is lowered."""
    return _known_reuse(_given_params(_one_package(system)))


def _one_package(system: System) -> System:
    package = system.name.replace(".", "_")
    offered = {name for owner in system.components for name in owner.operations}
    offered |= {name for part in all_parts(system) for name in part.operations}
    services = {
        function.communication.type: f"{component.name}{camel_case(operation_name(function))}"
        for component in system.components
        for function in map(system.function, own_operations(component, system))
    }
    own = [each.type for each in system.interfaces if not each.external]
    others = {
        *(each.name for each in system.events),
        *(each.name for each in system.functions if each.name not in offered),
        *(each.name for each in system.components),
        *(each.name for each in system.members),
        *(each.name for each in system.machines),
        *(each.name for each in system.environments),
        *(each.name for each in system.swarms),
        *(each.name for each in system.fitness),
    }
    count = Counter(type_.name for type_ in own)
    taken = {*others, *count}
    types: dict[Named, Named] = {}
    for type_ in own:
        name = type_.name
        shared = name in others or (count[name] > 1 and type_.package != package)
        if type_ in services:
            name = services[type_]
        elif shared:
            name = f"{type_.package}_{name}"
            while name in taken:
                name += "_"
            taken.add(name)
        types[type_] = Named(package, name)
    if all(old == new for old, new in types.items()):
        return system
    renamed = _renamed(system, types)
    assert isinstance(renamed, System)
    return renamed


def _renamed(node: Any, types: Mapping[Named, Named]) -> Any:
    """Return the system with interfaces renamed."""
    if isinstance(node, Named):
        return types.get(node, node)
    if isinstance(node, tuple):
        return tuple(_renamed(item, types) for item in node)
    if not is_dataclass(node) or isinstance(node, type):
        return node
    values = {field.name: _renamed(getattr(node, field.name), types) for field in fields(node)}
    return replace(node, **values)


def _given_params(system: System) -> System:
    needed = {
        machine.name: [param for param in machine.params if param.default is None]
        for machine in system.machines
    }
    return replace(
        system,
        components=_completed(system.components, needed),
        members=_completed(system.members, needed),
    )


def _completed(owners: tuple[Owner, ...], needed: Mapping[str, list[Param]]) -> tuple[Owner, ...]:
    """Return the owners with the params of their behaviours, inherited ones first."""
    before = {owner.name: owner for owner in owners}
    done: dict[str, tuple[Param, ...]] = {}

    def complete(owner: Owner) -> tuple[Param, ...]:
        if owner.name not in done:
            base = before[owner.base] if owner.base is not None else None
            inherited: tuple[Param, ...] = complete(base) if base is not None else ()
            known = {param.name: param for param in (*inherited, *owner.params)}
            for param in needed.get(owner.behavior or "", ()):
                known.setdefault(param.name, param)
            done[owner.name] = tuple(known.values())
        return done[owner.name]

    return tuple(replace(owner, params=complete(owner)) for owner in owners)


def _known_reuse(system: System) -> System:
    machines = dict(system.machines_by_name)
    while True:
        lost = [each for each in machines.values() if find_reuse(each, machines) is None]
        if not lost:
            return replace(system, machines=tuple(machines.values()))
        for machine in lost:
            machines[machine.name] = _without_reuse(machine)


def _without_reuse(node: StateMachine) -> StateMachine:
    def plain(state: Any) -> Any:
        return replace(state, submachine=None, states=tuple(map(plain, state.states)))

    return replace(node, states=tuple(map(plain, node.states)))
