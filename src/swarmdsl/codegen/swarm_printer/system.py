"""Print a whole system."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterator
from typing import TypeVar

from swarmdsl.codegen.swarm_printer.architecture import print_component, print_member
from swarmdsl.codegen.swarm_printer.composition import (
    print_environment,
    print_fitness,
    print_optimization,
    print_property,
    print_swarm,
)
from swarmdsl.codegen.swarm_printer.interfaces import print_event, print_function, print_interface
from swarmdsl.codegen.swarm_printer.layout import UnprintableError, documented
from swarmdsl.codegen.swarm_printer.machines import print_machine
from swarmdsl.codegen.swarm_printer.names import Names, all_parts, make_names, own_operations
from swarmdsl.codegen.swarm_printer.normal import normalized
from swarmdsl.codegen.swarm_printer.reuse import find_reuse
from swarmdsl.ir import System
from swarmdsl.syntax.parser.keywords import RESERVED

T = TypeVar("T")

_PACKAGE_NAME = re.compile(r"[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*", re.ASCII)


def print_system(system: System) -> str:
    """Return the system as one file.

    A package whose name is not valid in the language is left out: the file must have that name.
    """
    system = normalized(system)
    declarations = list(_declarations(system, make_names(system)))
    if _is_package_name(system.name):
        declarations.insert(0, documented(system.doc, [f"package {system.name}"]))
    return "\n".join("".join(f"{line}\n" for line in lines) for lines in declarations)


def _declarations(system: System, names: Names) -> Iterator[list[str]]:
    """Yield the lines of each declaration.

    A component declares its operations, which are functions and services. Declarations before those
    are printed before it, so that lowering restores their order. The functions of parts come last.
    """
    offered = set(names.operations)
    known = set(offered)
    services = {system.function(name).communication.type for name in offered}
    interfaces, functions = deque(system.interfaces), deque(system.functions)

    def some_interfaces() -> Iterator[list[str]]:
        for interface in _taken(interfaces, lambda each: each.type not in services):
            yield print_interface(interface, names)

    def some_functions() -> Iterator[list[str]]:
        for function in _taken(functions, lambda each: each.name not in offered):
            yield print_function(function, names)

    yield from some_interfaces()
    yield from (print_event(event, names) for event in system.events if not event.predefined)
    yield from some_functions()
    for component in system.components:
        yield print_component(component, system, names)
        for name in component.operations:
            # Missing if another component has its servers in the same namespace.
            if name not in known:
                continue
            known.remove(name)
            if functions.popleft().name != name:
                raise UnprintableError(f"operation `{name}` is not in the order of the components")
        for name in own_operations(component, system):
            if interfaces.popleft().type != system.function(name).communication.type:
                raise UnprintableError(f"operation `{name}` is not in the order of the components")
        yield from some_interfaces()
        yield from some_functions()
    left = {name: None for part in all_parts(system) for name in part.operations if name in known}
    if list(left) != [function.name for function in functions]:
        raise UnprintableError("the functions of parts are not in the order of the parts")
    yield from (print_member(member, system, names) for member in system.members)
    machines = system.machines_by_name
    for machine in system.machines:
        reuse = find_reuse(machine, machines)
        assert reuse is not None  # the system is in its normal form
        yield print_machine(machine, reuse, names)
    yield from map(print_environment, system.environments)
    yield from (print_fitness(fitness, names) for fitness in system.fitness)
    yield from map(print_swarm, system.swarms)
    yield from map(print_optimization, system.optimizations)
    yield from map(print_property, system.properties)


def _taken(items: deque[T], wanted: Callable[[T], bool]) -> Iterator[T]:
    """Take the leading items that are wanted."""
    while items and wanted(items[0]):
        yield items.popleft()


def _is_package_name(name: str) -> bool:
    """Return True if a name is valid after `package`."""
    return _PACKAGE_NAME.fullmatch(name) is not None and name.partition(".")[0] not in RESERVED


__all__ = ["UnprintableError", "normalized", "print_system"]
